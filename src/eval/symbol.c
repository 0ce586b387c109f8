#include "eval/symbol.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/diag.h"
#include "eval/array.h"

struct symbol {
    struct name *name;
    struct symbol *outer;         // the next older entry of the name
    struct symbol *next_in_scope; // or in the list of free entries
    uint32_t depth;
    bool unlinked;             // removed by #undef; a reference may still hold it
    bool is_number, is_string; // `own` holds the value
    bool is_reference;         // `refers` holds it
    struct value own;          // changed in place; a string's text is in `text`
    char *text;                // room for strings, kept from one to the next
    size_t text_capacity;
    const struct value *value; // of any other kind; NULL: none
    struct place refers;
};

struct name {
    struct name *next; // in its bucket
    struct symbol *top;
    uint32_t hash, len;
    char text[];
};

struct symbol_tables {
    struct arena *arena;
    struct name **bucket;
    uint32_t bucket_count, name_count; // bucket_count: a power of two
    struct symbol **scope;             // entries of each scope
    uint32_t depth, scope_capacity;
    struct symbol *free;
};

struct symbol_tables *symbols_new(void)
{
    struct arena *a = arena_new(1 << 16);
    struct symbol_tables *t = arena_new_struct(a, struct symbol_tables);
    t->arena = a;
    t->bucket_count = 1024;
    t->bucket = arena_new_array(a, struct name *, t->bucket_count);
    t->scope_capacity = 64;
    t->scope = arena_new_array(a, struct symbol *, t->scope_capacity);
    t->depth = 1;
    return t;
}

void symbols_free(struct symbol_tables *t)
{
    if (t)
        arena_free(t->arena);
}

static uint32_t hash_of(const char *s, size_t len)
{
    uint32_t h = 2166136261u; // FNV-1a
    for (size_t i = 0; i < len; i++)
        h = (h ^ (unsigned char)s[i]) * 16777619u;
    return h;
}

static struct name *find_name(const struct symbol_tables *t, const char *s, size_t len,
                              uint32_t hash)
{
    for (struct name *n = t->bucket[hash & (t->bucket_count - 1)]; n; n = n->next)
        if (n->hash == hash && n->len == len && !memcmp(n->text, s, len))
            return n;
    return NULL;
}

static void grow_buckets(struct symbol_tables *t)
{
    uint32_t count = 4 * t->bucket_count;
    struct name **bucket = arena_new_array(t->arena, struct name *, count);
    for (uint32_t i = 0; i < t->bucket_count; i++) {
        struct name *next;
        for (struct name *n = t->bucket[i]; n; n = next) {
            next = n->next;
            n->next = bucket[n->hash & (count - 1)];
            bucket[n->hash & (count - 1)] = n;
        }
    }
    t->bucket = bucket;
    t->bucket_count = count;
}

static struct name *intern(struct symbol_tables *t, const char *s, size_t len)
{
    uint32_t hash = hash_of(s, len);
    struct name *n = find_name(t, s, len, hash);
    if (n)
        return n;
    if (t->name_count++ > 2 * t->bucket_count)
        grow_buckets(t);
    n = arena_alloc(t->arena, sizeof *n + len + 1);
    n->hash = hash;
    n->len = (uint32_t)len;
    memcpy(n->text, s, len);
    n->next = t->bucket[hash & (t->bucket_count - 1)];
    t->bucket[hash & (t->bucket_count - 1)] = n;
    return n;
}

uint32_t symbols_depth(const struct symbol_tables *t) { return t->depth; }

void symbols_enter(struct symbol_tables *t)
{
    if (t->depth == t->scope_capacity) {
        struct symbol **grown = arena_new_array(t->arena, struct symbol *, 2 * t->depth);
        memcpy(grown, t->scope, t->depth * sizeof *grown);
        t->scope = grown;
        t->scope_capacity *= 2;
    }
    t->scope[t->depth++] = NULL;
}

static void unlink_symbol(struct symbol *s)
{
    struct symbol **at = &s->name->top;
    while (*at != s)
        at = &(*at)->outer;
    *at = s->outer;
}

void symbols_leave(struct symbol_tables *t)
{
    if (t->depth == 1)
        return;
    struct symbol *next;
    for (struct symbol *s = t->scope[--t->depth]; s; s = next) {
        next = s->next_in_scope;
        if (s->unlinked)
            continue;
        unlink_symbol(s);
        s->next_in_scope = t->free;
        t->free = s;
    }
}

static struct symbol *find_entry(struct symbol_tables *t, const char *name, size_t len,
                                 uint32_t depth)
{
    struct name *n = find_name(t, name, len, hash_of(name, len));
    struct symbol *s = n ? n->top : NULL;
    while (s && s->depth >= depth)
        s = s->outer;
    return s;
}

static struct place place_of(struct symbol *s)
{
    if (s && s->is_reference)
        return s->refers;
    return (struct place){.symbol = s};
}

struct place symbols_find(struct symbol_tables *t, const char *name, size_t len,
                          uint32_t depth)
{
    return place_of(find_entry(t, name, len, depth));
}

static struct symbol *make_entry_of(struct symbol_tables *t, struct name *name,
                                    uint32_t depth)
{
    struct symbol **at = &name->top;
    while (*at && (*at)->depth > depth)
        at = &(*at)->outer;
    struct symbol *s = *at;
    if (s && s->depth == depth)
        return s;
    s = t->free;
    if (s) {
        t->free = s->next_in_scope;
        *s = (struct symbol){.text = s->text, .text_capacity = s->text_capacity};
    } else {
        s = arena_new_struct(t->arena, struct symbol);
    }
    s->name = name;
    s->depth = depth;
    s->outer = *at;
    *at = s;
    s->next_in_scope = t->scope[depth];
    t->scope[depth] = s;
    return s;
}

static struct symbol *make_entry(struct symbol_tables *t, const char *text, size_t len,
                                 uint32_t depth)
{
    return make_entry_of(t, intern(t, text, len), depth);
}

struct name *symbols_name(struct symbol_tables *t, const char *text, size_t len)
{
    return intern(t, text, len);
}

struct place symbols_place(const struct symbol_tables *t, const struct name *name)
{
    (void)t;
    return place_of(name->top);
}

struct place symbols_place_for(struct symbol_tables *t, struct name *name, bool local)
{
    if (!local && name->top)
        return place_of(name->top);
    return place_of(make_entry_of(t, name, local ? t->depth - 1 : 0));
}

const struct value *symbol_value(const struct symbol *s) { return s->value; }

const struct value *symbol_number(const struct symbol *s)
{
    return s->is_number && !s->own.deprecated ? &s->own : NULL;
}

const struct value *symbol_string(const struct symbol *s)
{
    return s->is_string && !s->own.deprecated ? &s->own : NULL;
}

bool symbol_takes_number(const struct symbol *s)
{
    return !s->value ||
           (s->value->kind != VALUE_MACRO && s->value->kind != VALUE_FUNCTION);
}

bool symbol_set_number(struct symbol *s, const struct value *v)
{
    if (!symbol_takes_number(s))
        return false;
    s->is_number = true;
    s->is_string = false;
    s->value = NULL;
    s->own = *v;
    return true;
}

bool symbols_advance(struct symbol_tables *t, struct name *name, double by, double *out)
{
    struct symbol *s = name->top;
    if (!s || s->depth + 1 != t->depth || s->is_reference || !s->is_number ||
        s->own.width != 1 || s->own.deprecated)
        return false;
    *out = s->own.n[0] += by;
    return true;
}

struct place symbols_make(struct symbol_tables *t, const char *name, size_t len,
                          bool local)
{
    return place_of(make_entry(t, name, len, local ? t->depth - 1 : 0));
}

struct place symbols_make_at(struct symbol_tables *t, const char *name, size_t len,
                             uint32_t scope)
{
    return place_of(make_entry(t, name, len, scope - 1));
}

void symbols_refer(struct symbol_tables *t, const char *name, size_t len, struct place to)
{
    struct symbol *s = make_entry(t, name, len, t->depth - 1);
    s->is_reference = true;
    s->refers = to;
}

bool symbols_remove(struct symbol_tables *t, const char *name, size_t len)
{
    struct symbol *s = find_entry(t, name, len, t->depth);
    if (!s)
        return false;
    unlink_symbol(s);
    s->unlinked = true;
    return true;
}

const struct value *place_peek(struct arena *copies, struct place p)
{
    if (p.array)
        return array_get(copies, p.array, p.index);
    const struct symbol *s = p.symbol;
    return s->is_number || s->is_string ? &s->own : s->value;
}

const struct value *value_hold(struct arena *copies, const struct value *v)
{
    if (!v || (v->kind != VALUE_NUMBER && v->kind != VALUE_STRING))
        return v;
    struct value *copy = arena_new_struct(copies, struct value);
    *copy = *v;
    if (v->kind == VALUE_STRING)
        copy->string.text = arena_strndup(copies, v->string.text, v->string.len);
    return copy;
}

const struct value *place_get(struct arena *copies, struct place p)
{
    const struct value *v = place_peek(copies, p);
    return p.array ? v : value_hold(copies, v);
}

// Where a loop appends to a string, the room doubles.
static void keep_text(struct arena *a, struct symbol *s, const struct value *v)
{
    const size_t size = (size_t)v->string.len + 1;
    if (size > s->text_capacity) {
        s->text_capacity = size < 64 ? 64 : 2 * size;
        s->text = arena_alloc(a, s->text_capacity);
    }
    memmove(s->text, v->string.text, size);
    s->own = *v;
    s->own.string.text = s->text;
}

void symbol_append(struct arena *a, struct symbol *s, const char *text)
{
    const size_t old = s->own.string.len, more = strlen(text);
    if (old + more + 1 > s->text_capacity) {
        s->text_capacity = 2 * (old + more + 1);
        char *grown = arena_alloc(a, s->text_capacity);
        memcpy(grown, s->text, old);
        s->text = grown;
        s->own.string.text = grown;
    }
    memmove(s->text + old, text, more);
    s->text[old + more] = 0;
    s->own.string.len = (uint32_t)(old + more);
}

bool place_set(struct arena *a, struct place p, const struct value *v)
{
    if (p.array)
        return array_set(a, p.array, p.index, v);
    struct symbol *s = p.symbol;
    s->is_number = v->kind == VALUE_NUMBER;
    s->is_string = v->kind == VALUE_STRING;
    s->value = s->is_number || s->is_string ? NULL : v;
    if (s->is_number)
        s->own = *v;
    else if (s->is_string)
        keep_text(a, s, v);
    return true;
}

void place_clear(struct place p)
{
    if (p.array) {
        p.array->set[p.index] = false;
        return;
    }
    p.symbol->is_number = p.symbol->is_string = false;
    p.symbol->value = NULL;
}

static bool is_macro(const struct symbol *s)
{
    return !s->is_number && !s->is_reference && s->value && s->value->kind == VALUE_MACRO;
}

const char *symbols_closest(const struct symbol_tables *t, const char *name, size_t len,
                            bool macros_only)
{
    const char **list = malloc((t->name_count + 1) * sizeof *list);
    size_t count = 0;
    for (uint32_t i = 0; list && i < t->bucket_count; i++)
        for (const struct name *n = t->bucket[i]; n; n = n->next)
            if (n->top && (!macros_only || is_macro(n->top)))
                list[count++] = n->text;
    const char *found = count ? diag_closest(name, len, list, count) : NULL;
    free(list);
    return found;
}
