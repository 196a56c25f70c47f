/* Kills its process group and the command's before the KILL_AT-th call that changes a file, counted over all processes in KILL_COUNT.
   usage: LD_PRELOAD=kill_at.so KILL_COUNT=FILE KILL_AT=N KILL_PARENT=PID COMMAND
   N = 0 only counts; PID starts the command, which leads a process group; FILE has 16 bytes. A program that the command starts may
   lead a group of its own. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static volatile struct { long count; long command; } *shared;
static long at;

__attribute__((constructor)) static void begin(void) {
    const char *file = getenv("KILL_COUNT"), *number = getenv("KILL_AT"), *parent = getenv("KILL_PARENT");
    int fd = file ? (int)syscall(257 /* openat */, AT_FDCWD, file, O_RDWR | O_CLOEXEC) : -1;
    if (fd < 0) return;
    void *memory = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    close(fd);
    if (memory == MAP_FAILED) return;
    shared = memory;
    at = number ? atol(number) : 0;
    if (parent && getppid() == atol(parent)) shared->command = getpid();
}

static void step(void) {
    if (!shared || __sync_add_and_fetch(&shared->count, 1) != at) return;
    if (getpgrp() != shared->command) kill(-(pid_t)shared->command, SIGKILL);
    kill(0, SIGKILL);
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define CHANGES(flags) ((flags) & (O_CREAT | O_TRUNC))
#define STEP(type, name, declared, handed) \
    type name declared { step(); return NEXT(name) handed; }
#define OPEN(name) \
    int name(const char *path, int flags, ...) { \
        va_list more; va_start(more, flags); mode_t mode = va_arg(more, mode_t); va_end(more); \
        if (CHANGES(flags)) step(); \
        return NEXT(name)(path, flags, mode); }
#define OPENAT(name) \
    int name(int folder, const char *path, int flags, ...) { \
        va_list more; va_start(more, flags); mode_t mode = va_arg(more, mode_t); va_end(more); \
        if (CHANGES(flags)) step(); \
        return NEXT(name)(folder, path, flags, mode); }

OPEN(open) OPEN(open64) OPENAT(openat) OPENAT(openat64)
STEP(int, rename, (const char *a, const char *b), (a, b))
STEP(int, renameat, (int f, const char *a, int g, const char *b), (f, a, g, b))
STEP(int, renameat2, (int f, const char *a, int g, const char *b, unsigned h), (f, a, g, b, h))
STEP(int, link, (const char *a, const char *b), (a, b))
STEP(int, linkat, (int f, const char *a, int g, const char *b, int h), (f, a, g, b, h))
STEP(int, symlink, (const char *a, const char *b), (a, b))
STEP(int, symlinkat, (const char *a, int f, const char *b), (a, f, b))
STEP(int, unlink, (const char *a), (a))
STEP(int, unlinkat, (int f, const char *a, int g), (f, a, g))
STEP(int, mkdir, (const char *a, mode_t m), (a, m))
STEP(int, rmdir, (const char *a), (a))
STEP(int, chmod, (const char *a, mode_t m), (a, m))
STEP(int, fchmod, (int f, mode_t m), (f, m))
STEP(int, fsync, (int f), (f))
STEP(int, syncfs, (int f), (f))
ssize_t write(int fd, const void *data, size_t size) {
    if (fd > 2) step();
    return NEXT(write)(fd, data, size);
}
