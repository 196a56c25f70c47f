/* Counts requests for more than 512 bytes, between begin() and end(): what Python's own allocator does not serve. */
#define _GNU_SOURCE
#include <stddef.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);

static int counting;
static long count;
static size_t largest;

static void note(size_t bytes)
{
    if (counting && bytes > 512) {
        count++;
        if (bytes > largest)
            largest = bytes;
    }
}

void begin(void) { count = 0; largest = 0; counting = 1; }
long end(void) { counting = 0; return count; }
long worst(void) { return (long)largest; }

void *malloc(size_t bytes) { note(bytes); return __libc_malloc(bytes); }
void *calloc(size_t number, size_t bytes) { note(number * bytes); return __libc_calloc(number, bytes); }
void *realloc(void *old, size_t bytes) { note(bytes); return __libc_realloc(old, bytes); }

void *mmap(void *at, size_t bytes, int protection, int flags, int file, off_t offset)
{
    note(bytes);
    return (void *)syscall(SYS_mmap, at, bytes, protection, flags, file, offset);
}
