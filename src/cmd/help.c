// Help, manual page and completion, all made from the table of options.
#include "cmd/cmd.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char *group, *title;
} groups[] = {
    {"scene", "Scene"},         {"picture", "Picture"},
    {"output", "Output"},       {"quality", "Quality"},
    {"radiosity", "Radiosity"}, {"run", "Running"},
    {"animation", "Animation"}, {"commands", "Commands around pictures"},
    {"tools", "Tools"},         {"compare", "lambert compare"},
    {"fmt", "lambert fmt"},     {"mesh", "lambert mesh"},
};
enum { GROUP_COUNT = sizeof groups / sizeof groups[0] };

static const char *const examples[][2] = {
    {"lambert scene.pov", "render to scene.png"},
    {"lambert scene.pov +W800 +H600 +A0.3", "POV-Ray's switches work"},
    {"lambert scene.pov --width 800 -o out.exr", "so do long options"},
    {"lambert check scene.pov", "read it and say what is wrong"},
    {"lambert fmt -i scene.pov", "indent it anew"},
    {"lambert mesh scene.pov -o scene.obj", "its solids as triangle meshes"},
    {"lambert compare a.png b.png", "how much two pictures differ"},
    {"lambert compare scene.pov --out DIR", "render with POV-Ray too and compare"},
};
enum { EXAMPLE_COUNT = sizeof examples / sizeof examples[0] };

// Columns: of a terminal, and before what the long and the brief help say of an option.
enum { COLUMNS = 78, LONG_FORMS = 33, BRIEF_FORMS = 41 };

// "--width=N, +WN, Width=N" with the forms the option has.
static void print_forms(FILE *out, const struct lambert_option *o, bool all)
{
    const char *value = o->value ? o->value : "";
    if (o->letter)
        fprintf(out, "-%s%s%s, ", o->letter, o->value && *value != '[' ? " " : "",
                o->value && *value != '[' ? value : "");
    fprintf(out, "--%s", o->name);
    if (*value == '[')
        fprintf(out, "[=%.*s]", (int)(strlen(value) - 2), value + 1);
    else if (*value)
        fprintf(out, " %s", value);
    if (o->pov)
        fprintf(out, ", +%s%s", o->pov, value);
    if (o->keyword && all)
        fprintf(out, ", %s=", o->keyword);
}

// The same as text, to be freed.
static char *forms_of(const struct lambert_option *o, bool all)
{
    char *forms = NULL;
    size_t n = 0;
    FILE *text = must_have(open_memstream(&forms, &n));
    print_forms(text, o, all);
    fclose(text);
    return forms;
}

// What an option does beside its forms, or below them where they are long.
static void print_help(FILE *out, const char *forms, int width, const char *help)
{
    if (strlen(forms) > (size_t)width)
        fprintf(out, "  %s\n  %*s %s", forms, width, "", help);
    else
        fprintf(out, "  %-*s %s", width, forms, help);
}

static void print_details(FILE *out, const struct lambert_option *o)
{
    if (o->choices)
        fprintf(out, " (%s)", o->choices);
    if (o->initial && strcmp(o->initial, "off") != 0)
        fprintf(out, " [%s]", o->initial);
}

static void print_group(FILE *out, const char *group)
{
    const struct lambert_option *o;
    for (size_t i = 0; (o = lambert_option_at(i)); i++) {
        if (strcmp(o->group, group) != 0)
            continue;
        char *forms = forms_of(o, true);
        print_help(out, forms, LONG_FORMS, o->help);
        free(forms);
        print_details(out, o);
        fputc('\n', out);
    }
}

static void print_names(FILE *out, const char *group)
{
    const struct lambert_option *o;
    int column = 0;
    for (size_t i = 0; (o = lambert_option_at(i)); i++) {
        if (strcmp(o->group, group) != 0 || !o->keyword)
            continue;
        int n = (int)strlen(o->keyword) + 2;
        if (column + n > COLUMNS - 2)
            column = fprintf(out, "\n") - 1;
        column += fprintf(out, "  %s", o->keyword);
    }
    fputc('\n', out);
}

static void print_usage(FILE *out)
{
    fputs("usage: lambert SCENE [options]\n"
          "       lambert compare A B\n"
          "       lambert compare SCENE... [options]\n"
          "       lambert check SCENE... [options]\n"
          "       lambert fmt [--check | --in-place] SCENE...\n"
          "       lambert mesh SCENE -o NAME.obj|.stl|.ply\n\nexamples:\n",
          out);
    for (int i = 0; i < EXAMPLE_COUNT; i++)
        fprintf(out, "  %-42s %s\n", examples[i][0], examples[i][1]);
}

static void print_common(FILE *out)
{
    static const char *const common[] = {
        "output",       "width",   "height", "antialias", "quality", "threads",
        "library-path", "declare", "quiet",  "stats",     "version"};
    fputs("\noptions:\n", out);
    for (size_t i = 0; i < sizeof common / sizeof common[0]; i++) {
        const struct lambert_option *o = lambert_option_find(common[i]);
        char *forms = forms_of(o, false);
        print_help(out, forms, BRIEF_FORMS, o->help);
        fputc('\n', out);
        free(forms);
    }
    fputs("\n--help=all shows every option; 'man lambert' is the manual.\n", out);
}

static void print_all(FILE *out)
{
    for (int i = 0; i < GROUP_COUNT; i++) {
        fprintf(out, "\n%s:\n", groups[i].title);
        print_group(out, groups[i].group);
    }
    fputs("\nOptions of POV-Ray that are taken and change nothing:\n", out);
    print_names(out, "compatibility");
}

void help_print(FILE *out, bool all)
{
    print_usage(out);
    if (all)
        print_all(out);
    else
        print_common(out);
}

// Text for roff, where a plain '-' may become a hyphen.
static void roff(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '-')
            fputs("\\-", out);
        else if (*text == '\\')
            fputs("\\e", out);
        else
            fputc(*text, out);
    }
}

static void man_option(FILE *out, const struct lambert_option *o)
{
    char *forms = forms_of(o, true);
    fputs(".TP\n.B ", out);
    roff(out, forms);
    fputc('\n', out);
    roff(out, o->help);
    if (o->choices) {
        fputs(". One of ", out);
        roff(out, o->choices);
    }
    if (o->initial) {
        fputs(". Default: ", out);
        roff(out, o->initial);
    }
    fputs(".\n", out);
    free(forms);
}

static void man_names(FILE *out, const char *group)
{
    const struct lambert_option *o;
    const char *comma = "";
    for (size_t i = 0; (o = lambert_option_at(i)); i++)
        if (strcmp(o->group, group) == 0 && o->keyword) {
            fprintf(out, "%s%s", comma, o->keyword);
            comma = ",\n";
        }
    fputs(".\n", out);
}

static const char man_head[] =
    ".SH NAME\n"
    "lambert \\- render scenes written in POV\\-Ray's language\n"
    ".SH SYNOPSIS\n"
    ".B lambert\n.I SCENE\n[\\fIoptions\\fR]\n.br\n"
    ".B lambert compare\n.I A B\n.br\n"
    ".B lambert compare\n.I SCENE\\fR...\n[\\fIoptions\\fR]\n.br\n"
    ".B lambert check\n.I SCENE\\fR...\n[\\fIoptions\\fR]\n.br\n"
    ".B lambert fmt\n[\\-\\-check | \\-\\-in\\-place]\n.I SCENE\\fR...\n.br\n"
    ".B lambert mesh\n.I SCENE\n.B \\-o\n.I NAME\n"
    ".SH DESCRIPTION\n"
    "Reads a scene, traces it and writes a picture, by default\n"
    "a PNG file named after the scene, beside it.\n"
    ".PP\n"
    "Every setting can be given as a long option, as a switch of POV\\-Ray\n"
    "(+ turns on, \\- turns off, the value follows at once, case does not matter)\n"
    "and as\n.I Keyword=value\non the command line or in an INI file.\n"
    "An argument that ends in\n.B .ini\nis an INI file,\n"
    ".I file.ini[section]\nreads one section of it as well.\n"
    "Later settings win; library paths and declarations add up.\n";

static const char man_tail[] =
    ".SH CHECK\n"
    ".B lambert check SCENE...\n"
    "reads and evaluates each scene, renders nothing, and says all that is wrong;\n"
    ".B \\-\\-diagnostics\nchooses how.\n"
    "The exit code is 0 when no scene has an error.\n"
    ".SH FMT\n"
    ".B lambert fmt SCENE...\n"
    "prints each scene with its lines indented by what is open before them. Tokens,\n"
    "comments and line ends stay; blanks at the ends of lines go.\n"
    ".B \\-\\-in\\-place\nwrites the files back,\n"
    ".B \\-\\-check\nnames those that would change and exits with 1.\n"
    ".SH MESH\n"
    ".B lambert mesh SCENE \\-o NAME\n"
    "writes the objects of a scene as triangle meshes (NAME ends in .obj, .stl or "
    ".ply):\n"
    "solids closed and turned outward by the right-hand rule in the scene's "
    "coordinates,\n"
    "meshes as they are. Objects without an end or an inside are named and left out.\n"
    ".SH COMPARE\n"
    ".B lambert compare A B\n"
    "says how much two pictures differ: the part of the pixels that are off,\n"
    "root mean square error and signal to noise ratio of the values as shown.\n"
    ".B lambert compare SCENE...\n"
    "renders each scene with lambert and with POV\\-Ray at the same settings and says "
    "so\n"
    "for each: match (at most 1 % of the pixels are off), near (5 %), far, or not "
    "rendered.\n"
    "Both pictures and a heat map go to the folder of\n.BR \\-\\-out .\n"
    ".SH EXIT STATUS\n"
    ".TP\n0\nAll went well, or the pictures agree.\n"
    ".TP\n1\nThe scene has errors, or the pictures differ.\n"
    ".TP\n2\nInterrupted; what was done is in the picture.\n"
    ".TP\n64\nThe command line makes no sense.\n"
    ".TP\n66\nAn input file cannot be read.\n"
    ".TP\n73\nThe picture cannot be written.\n"
    ".TP\n74\nStandard output cannot be written.\n"
    ".SH ENVIRONMENT\n"
    ".TP\n.B LAMBERT_PATH\nMore folders for includes, separated by colons.\n"
    ".TP\n.B POVINC\nThe same, after those.\n"
    ".TP\n.B POVINI\nAn INI file read before the command line.\n"
    ".TP\n.B NO_COLOR\nNo colour in messages.\n"
    ".TP\n.B TMPDIR\nWhere a picture goes that cannot be written where it should; else "
    "/tmp.\n"
    ".SH SIGNALS\n"
    "The first SIGINT or SIGTERM ends the rendering after the tiles in hand, or within "
    "those\n"
    "that take long, and writes what there is; a second one ends the program at once.\n";

void man_print(FILE *out)
{
    const struct lambert_option *o;
    fprintf(out, ".TH LAMBERT 1 \"\" \"lambert %s\" \"User Commands\"\n%s",
            lambert_version(), man_head);
    fputs(".SH EXAMPLES\n", out);
    for (int i = 0; i < EXAMPLE_COUNT; i++) {
        fputs(".TP\n.B ", out);
        roff(out, examples[i][0]);
        fprintf(out, "\n%s\n", examples[i][1]);
    }
    fputs(".SH OPTIONS\n", out);
    for (int g = 0; g < GROUP_COUNT; g++) {
        fprintf(out, ".SS \"%s\"\n", groups[g].title);
        for (size_t i = 0; (o = lambert_option_at(i)); i++)
            if (strcmp(o->group, groups[g].group) == 0)
                man_option(out, o);
    }
    fputs(".SS \"Taken, without effect\"\n", out);
    man_names(out, "compatibility");
    fputs(man_tail, out);
}

void completion_print(FILE *out)
{
    const struct lambert_option *o;
    fputs("# bash completion for lambert, made by lambert --completion=bash\n"
          "_lambert()\n{\n    local cur=${COMP_WORDS[COMP_CWORD]} "
          "prev=${COMP_WORDS[COMP_CWORD-1]}\n    COMPREPLY=()\n    case $prev in\n",
          out);
    for (size_t i = 0; (o = lambert_option_at(i)); i++) {
        if (!*o->help || !o->choices || (o->value && o->value[0] == '['))
            continue;
        fprintf(out, "    --%s) COMPREPLY=($(compgen -W '", o->name);
        for (const char *p = o->choices; *p; p++)
            fputc(*p == '|' ? ' ' : *p, out);
        fputs("' -- \"$cur\")); return ;;\n", out);
    }
    fputs("    esac\n    case $cur in\n    -*) COMPREPLY=($(compgen -W '", out);
    for (size_t i = 0; (o = lambert_option_at(i)); i++)
        if (*o->help)
            fprintf(out, "--%s ", o->name);
    fputs("' -- \"$cur\")) ;;\n    *) COMPREPLY=($(compgen -f -- \"$cur\"))\n"
          "       test \"$COMP_CWORD\" = 1 && "
          "COMPREPLY+=($(compgen -W 'check compare fmt mesh' -- \"$cur\")) ;;\n"
          "    esac\n}\ncomplete -o filenames -F _lambert lambert\n",
          out);
}
