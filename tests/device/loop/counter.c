/* Loaded before the C library: counts what is allocated between `counting_begin` and `counting_end`. */
#define _GNU_SOURCE
#include <stddef.h>
#include <malloc.h>
#include <sys/types.h>

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);
extern void __libc_free(void *);

enum { LARGE = 512, KEPT = 32 };
static int counting;
static long large, taken_bytes, freed_bytes;
static size_t sizes[KEPT];

static void *count(void *block, size_t size)
{
    if (counting && block) {
        taken_bytes += malloc_usable_size(block);
        if (size > LARGE) {
            if (large < KEPT) sizes[large] = size;
            large++;
        }
    }
    return block;
}

static void gone(void *block)
{
    if (counting && block) freed_bytes += malloc_usable_size(block);
}

void *malloc(size_t size) { return count(__libc_malloc(size), size); }
void *calloc(size_t n, size_t size) { return count(__libc_calloc(n, size), n * size); }
void *realloc(void *block, size_t size) { gone(block); return count(__libc_realloc(block, size), size); }
void free(void *block) { gone(block); __libc_free(block); }

void counting_begin(void) { large = taken_bytes = freed_bytes = 0; counting = 1; }
void counting_end(void) { counting = 0; }
long counted_large(void) { return large; }
long counted_growth_bytes(void) { return taken_bytes - freed_bytes; }
long counted_taken_bytes(void) { return taken_bytes; }
size_t counted_size(int index) { return sizes[index]; }
