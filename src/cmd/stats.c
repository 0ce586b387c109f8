// What --stats tells when a picture is done.
#include "cmd/cmd.h"

static void print_json_text(FILE *out, const char *s)
{
    fputc('"', out);
    for (; *s; s++) {
        unsigned char ch = (unsigned char)*s;
        if (ch == '"' || ch == '\\')
            fprintf(out, "\\%c", ch);
        else if (ch < 0x20)
            fprintf(out, "\\u%04x", ch);
        else
            fputc(ch, out);
    }
    fputc('"', out);
}

static void print_json(struct cmd *c, FILE *out, const struct lambert_stats *s,
                       const char *picture)
{
    fputs("{\"v\":1,\"t\":\"stats\",\"scene\":", out);
    print_json_text(out, lambert_option_text(c->ctx, "input"));
    fputs(",\"picture\":", out);
    print_json_text(out, picture ? picture : "");
    fprintf(out, ",\"parse_seconds\":%.6f,\"build_seconds\":%.6f,\"trace_seconds\":%.6f",
            s->parse_seconds, s->build_seconds, s->trace_seconds);
    fprintf(out, ",\"write_seconds\":%.6f,\"trace_cpu_seconds\":%.6f", s->write_seconds,
            s->trace_cpu_seconds);
    fprintf(out, ",\"pixels\":%llu,\"samples\":%llu,\"rays\":%llu,\"shadow_rays\":%llu",
            (unsigned long long)s->pixels, (unsigned long long)s->samples,
            (unsigned long long)s->rays, (unsigned long long)s->shadow_rays);
    fprintf(out, ",\"node_visits\":%llu,\"leaf_tests\":%llu,\"csg_tests\":%llu",
            (unsigned long long)s->node_visits, (unsigned long long)s->leaf_tests,
            (unsigned long long)s->csg_tests);
    fprintf(out, ",\"function_evaluations\":%llu",
            (unsigned long long)s->function_evaluations);
    fprintf(out, ",\"tiles_done\":%u,\"tiles_total\":%u,\"objects\":%u,\"leaves\":%u",
            s->tiles_done, s->tiles_total, s->objects, s->leaves);
    fprintf(out, ",\"lights\":%u,\"memory_peak\":%llu,\"warnings\":%u}\n", s->lights,
            (unsigned long long)s->memory_peak, s->warnings);
}

void stats_print(struct cmd *c, FILE *out, bool json, const char *picture)
{
    struct lambert_stats s;
    lambert_get_stats(c->ctx, &s);
    if (json) {
        print_json(c, out, &s, picture);
        return;
    }
    double rays = (double)(s.rays + s.shadow_rays);
    fprintf(out, "parse %.3f s, build %.3f s, trace %.3f s, write %.3f s\n",
            s.parse_seconds, s.build_seconds, s.trace_seconds, s.write_seconds);
    fprintf(out, "objects %u, shapes %u, lights %u\n", s.objects, s.leaves, s.lights);
    fprintf(out, "pixels %llu, samples %llu, rays %llu, shadow rays %llu",
            (unsigned long long)s.pixels, (unsigned long long)s.samples,
            (unsigned long long)s.rays, (unsigned long long)s.shadow_rays);
    if (s.trace_seconds > 0)
        fprintf(out, " (%.3g million rays/s)", rays / s.trace_seconds * 1e-6);
    fprintf(out, "\nnode visits %llu, shape tests %llu, CSG tests %llu\n",
            (unsigned long long)s.node_visits, (unsigned long long)s.leaf_tests,
            (unsigned long long)s.csg_tests);
    if (s.function_evaluations)
        fprintf(out, "function evaluations for surfaces %llu (%.3g a ray)\n",
                (unsigned long long)s.function_evaluations,
                (double)s.function_evaluations / rays);
    fprintf(out, "memory at most %.1f MB\n", (double)s.memory_peak / 1048576);
}
