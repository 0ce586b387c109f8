// Mutation fuzzing without a fuzzing engine: makes COUNT mutants of the seed files,
// feeds each to the fuzz target, and reports crashes and runs over the time limit.
//
//   fuzz_parse COUNT  (or fuzz_image, for seeds that are no text) [-s SEED] [-t SECONDS] FILE...
//
// The seeds themselves come first. Mutants are made of bytes, tokens and splices of two seeds;
// those of binary seeds of bytes and of numbers of 8, 16 and 32 bits. They run in a child
// process, a batch at a time; a child that dies or hangs names its mutant, which is
// written to crash-N.scn for the corpus. Exit code 1 when there was any. Built with
// the sanitizers this is the ten-thousand-mutants run of the test suite's long mode.
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { BATCH = 50, SIZE_MAX_MUTANT = 1 << 16 };

struct seed {
    char *text;
    size_t size;
    bool binary;
};

struct random {
    uint64_t state;
};

static uint32_t next(struct random *r)
{
    r->state = r->state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(r->state >> 33);
}

static size_t below(struct random *r, size_t n) { return n ? next(r) % n : 0; }

static bool load(const char *path, struct seed *out)
{
    FILE *f = fopen(path, "rb");
    if (!f)
        return false;
    out->text = malloc(SIZE_MAX_MUTANT);
    out->size = out->text ? fread(out->text, 1, SIZE_MAX_MUTANT / 2, f) : 0;
    fclose(f);
    out->binary = out->size > 0 && memchr(out->text, 0, out->size);
    if (out->size > 0)
        return true;
    free(out->text);
    return false;
}

struct buffer {
    char text[SIZE_MAX_MUTANT];
    size_t size;
};

static void replace(struct buffer *b, size_t at, size_t len, const char *with, size_t n)
{
    if (b->size - len + n > sizeof b->text)
        return;
    memmove(b->text + at + n, b->text + at + len, b->size - at - len);
    memcpy(b->text + at, with, n);
    b->size += n - len;
}

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           c == '_' || c == '.';
}

// The token at or after a random place.
static void token_at(const char *text, size_t size, struct random *r, size_t *at,
                     size_t *len)
{
    size_t i = below(r, size);
    while (i > 0 && is_word(text[i]) && is_word(text[i - 1]))
        i--;
    size_t n = 1;
    if (is_word(text[i]))
        while (i + n < size && is_word(text[i + n]))
            n++;
    *at = i;
    *len = n;
}

// Another value for a number leaves the scene readable: these mutants reach the shapes
// and the tracer.
static void mutate_number(struct buffer *b, struct random *r)
{
    static const char *const values[] = {
        "0",     "-1",     "1",      "0.5",   "2",     "1e308", "-1e308", "1e-308",
        "1e-12", "1e999",  "-1e999", "1e30",  "-1e30", "1e10",  "1e-5",   "3",
        "100",   "-0.001", "255",    "65536", "1e6",   "4",     "16",
    };
    size_t at = below(r, b->size), n = 0;
    while (at < b->size && !(b->text[at] >= '0' && b->text[at] <= '9'))
        at++;
    while (at + n < b->size &&
           ((b->text[at + n] >= '0' && b->text[at + n] <= '9') || b->text[at + n] == '.'))
        n++;
    const char *with = values[below(r, sizeof values / sizeof values[0])];
    replace(b, at, n, with, strlen(with));
}

// Text that means something to the parser.
static const char *const spice[] = {"{",
                                    "}",
                                    "(",
                                    ")",
                                    "<",
                                    ">",
                                    "#end",
                                    "#if (1)",
                                    "#while (0)",
                                    "#macro M()",
                                    "#declare A = ",
                                    ";",
                                    ",",
                                    "1e308",
                                    "-1e-308",
                                    "0",
                                    "1e999",
                                    "\"",
                                    "/*",
                                    "*/",
                                    "//",
                                    "#include \"x.inc\"",
                                    "[",
                                    "]",
                                    "#else",
                                    "#local A = A + 1;",
                                    "rgb",
                                    "<1,2,3,4,5,6>",
                                    "\xff",
                                    "union {",
                                    "texture {",
                                    "pigment {",
                                    "#for (I, 0, 3)",
                                    "#break",
                                    "#switch (1)",
                                    "array[3]",
                                    "A[0]",
                                    "seed(1)",
                                    "rand(0)",
                                    "0/0",
                                    ".x",
                                    "?",
                                    ":",
                                    "!",
                                    "#default {",
                                    "#version 3.1;",
                                    "matrix",
                                    "function { x }",
                                    "inverse",
                                    "scale 0",
                                    "rotate"};

static void mutate_once(struct buffer *b, const struct seed *seeds, size_t count,
                        struct random *r)
{
    const struct seed *other = &seeds[below(r, count)];
    size_t at, len, from, n;
    if (b->size < 2)
        return;
    token_at(b->text, b->size, r, &at, &len);
    switch (below(r, 12)) {
    case 0: // flip a byte
        b->text[below(r, b->size)] ^= (char)(1 << below(r, 8));
        break;
    case 1: // drop a token
        replace(b, at, len, "", 0);
        break;
    case 2: { // put something nasty in its place or before it
        const char *s = spice[below(r, sizeof spice / sizeof spice[0])];
        replace(b, at, below(r, 2) ? len : 0, s, strlen(s));
        break;
    }
    case 3: // a token of another seed
        token_at(other->text, other->size, r, &from, &n);
        replace(b, at, len, other->text + from, n);
        break;
    case 4: // a stretch of another seed
        from = below(r, other->size);
        n = below(r, other->size - from < 400 ? other->size - from : 400);
        replace(b, at, 0, other->text + from, n);
        break;
    case 5: // drop a stretch
        n = below(r, 200);
        replace(b, at, n < b->size - at ? n : b->size - at, "", 0);
        break;
    case 6: // end early
        if (below(r, 4) == 0)
            b->size = at;
        break;
    default: mutate_number(b, r); break;
    }
}

// Numbers at the ends of ranges, in either byte order; bytes, stretches, an early end.
static void mutate_bytes(struct buffer *b, const struct seed *seeds, size_t count,
                         struct random *r)
{
    static const uint32_t values[] = {
        0,      1,      2,       3,          4,          8,         16,
        24,     32,     127,     128,        255,        256,       0x7fff,
        0x8000, 0xffff, 0x10000, 0x7fffffff, 0x80000000, 0xffffffff};
    const struct seed *other = &seeds[below(r, count)];
    if (b->size < 2)
        return;
    // Headers decide most, and stand first.
    size_t at = below(r, below(r, 2) && b->size > 64 ? 64 : b->size);
    const size_t rest = b->size - at;
    switch (below(r, 8)) {
    case 0:
    case 1: b->text[at] ^= (char)(1 << below(r, 8)); break;
    case 2: b->text[at] = (char)next(r); break;
    case 3:
    case 4: {
        uint32_t v = values[below(r, sizeof values / sizeof values[0])];
        size_t n = (size_t)1 << below(r, 3);
        bool big = below(r, 2);
        for (size_t i = 0; i < n && i < rest; i++)
            b->text[at + i] = (char)(v >> 8 * (big ? n - 1 - i : i));
        break;
    }
    case 5: { // a stretch of another seed, over or before what is there
        size_t from = below(r, other->size), n = 1 + below(r, 64);
        n = n < other->size - from ? n : other->size - from;
        replace(b, at, below(r, 2) && n < rest ? n : 0, other->text + from, n);
        break;
    }
    case 6: {
        size_t n = 1 + below(r, 40);
        replace(b, at, n < rest ? n : rest, "", 0);
        break;
    }
    default:
        if (below(r, 3) == 0)
            b->size = at + 1;
        break;
    }
}

static void make_mutant(struct buffer *b, const struct seed *seeds, size_t count,
                        uint64_t number, uint64_t seed)
{
    struct random r = {number * 0x9e3779b97f4a7c15u + seed};
    for (int i = 0; i < 4; i++)
        next(&r);
    const struct seed *s = &seeds[number < count ? number : below(&r, count)];
    memcpy(b->text, s->text, s->size);
    b->size = s->size;
    if (number < count) // each seed as it is comes first
        return;
    for (size_t times = 1 + below(&r, 8); times > 0; times--) {
        if (s->binary)
            mutate_bytes(b, seeds, count, &r);
        else
            mutate_once(b, seeds, count, &r);
    }
}

struct job {
    const struct seed *seeds;
    size_t seed_count;
    uint64_t seed, count;
    unsigned seconds;
    volatile uint64_t *current; // shared with the child: the mutant in progress
};

static void save(const struct job *job, uint64_t number)
{
    static const char pattern[] = "crash-%llu.scn";
    char path[64];
    struct buffer *b = malloc(sizeof *b);
    if (!b)
        return;
    make_mutant(b, job->seeds, job->seed_count, number, job->seed);
    snprintf(path, sizeof path, pattern, (unsigned long long)number);
    FILE *f = fopen(path, "wb");
    if (f) {
        fwrite(b->text, 1, b->size, f);
        fclose(f);
    }
    free(b);
}

// The default action of either signal ends the child. Processor time, so that a busy machine
// makes no mutant slow; and thirty times as long on the clock, for one that only waits.
static void limit_time(unsigned seconds)
{
    enum { WAITING = 30 };
    const struct itimerval limit = {.it_value.tv_sec = seconds};
    setitimer(ITIMER_PROF, &limit, NULL);
    alarm(WAITING * seconds);
}

static void run_batch(const struct job *job, uint64_t begin, uint64_t end)
{
    struct buffer *b = malloc(sizeof *b);
    if (!b)
        _exit(2);
    for (uint64_t i = begin; i < end; i++) {
        *job->current = i;
        limit_time(job->seconds);
        make_mutant(b, job->seeds, job->seed_count, i, job->seed);
        uint8_t *copy = malloc(b->size ? b->size : 1); // exact size: overreads show
        memcpy(copy, b->text, b->size);
        LLVMFuzzerTestOneInput(copy, b->size);
        free(copy);
    }
    free(b);
    exit(0); // through atexit, so that leaks are looked for
}

static unsigned run(const struct job *job)
{
    unsigned bad = 0;
    uint64_t alone = 0; // mutants below this run one by one: a batch of them failed
    for (uint64_t at = 0; at < job->count;) {
        uint64_t batch = at < alone ? 1 : BATCH;
        uint64_t end = at + batch < job->count ? at + batch : job->count;
        fflush(NULL);
        pid_t child = fork();
        if (child == 0)
            run_batch(job, at, end);
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) < 0) {
            perror("mutate");
            return bad + 1;
        }
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
            at = end;
            continue;
        }
        if (batch > 1 && WIFEXITED(status)) { // a leak shows only at the end
            alone = end;
            continue;
        }
        bad++;
        const int by = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        printf("mutant %llu: %s\n", (unsigned long long)*job->current,
               by == SIGPROF || by == SIGALRM ? "over the time limit" : "died");
        fflush(stdout);
        save(job, *job->current);
        at = *job->current + 1;
    }
    return bad;
}

int main(int argc, char **argv)
{
    struct job job = {.seed = 1, .seconds = 10};
    int i = 1;
    if (argc < 3)
        return fprintf(stderr,
                       "usage: fuzz_parse COUNT [-s SEED] [-t SECONDS] FILE...\n"),
               64;
    job.count = strtoull(argv[i++], NULL, 10);
    for (; i + 1 < argc && argv[i][0] == '-'; i += 2) {
        if (argv[i][1] == 's')
            job.seed = strtoull(argv[i + 1], NULL, 10);
        else if (argv[i][1] == 't')
            job.seconds = (unsigned)strtoul(argv[i + 1], NULL, 10);
    }
    struct seed *seeds = calloc((size_t)argc, sizeof *seeds);
    for (; seeds && i < argc; i++)
        if (load(argv[i], &seeds[job.seed_count]))
            job.seed_count++;
    job.seeds = seeds;
    job.current = mmap(NULL, sizeof *job.current, PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    job.count += job.seed_count;
    if (!seeds || !job.seed_count || job.current == MAP_FAILED)
        return fprintf(stderr, "mutate: no seed file could be read\n"), 66;
    unsigned bad = run(&job);
    for (size_t k = 0; k < job.seed_count; k++)
        free(seeds[k].text);
    free(seeds);
    printf("%llu mutants, %u bad\n", (unsigned long long)job.count, bad);
    return bad != 0;
}
