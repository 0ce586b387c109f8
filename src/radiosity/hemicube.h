#ifndef RADIOSITY_HEMICUBE_H
#define RADIOSITY_HEMICUBE_H

struct hemicube;
struct hemicube *hemicube_new(int resolution);
void hemicube_free(struct hemicube *h);

#endif
