#while (
#if (1)
