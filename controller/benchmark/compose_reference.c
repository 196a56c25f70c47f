/* What composing at full amplitude costs in plain C: loops as they are written down, made into vectors of 128 bits by the compiler.
   It has nothing of the product's kernel; it gives the same words. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { CHANNELS = 32, SAMPLES = 1000, VALUES = SAMPLES * CHANNELS, POINTS = 10 };

struct bank {
    const int8_t *response;
    const int32_t *entry_of;
    const float *scale_of;
    int64_t stride, nx, ny;
    double pitch_m, x0_m, y0_m;
    uint32_t idle_word;
};

static int16_t response_of[POINTS][VALUES];
static int32_t sum_of[VALUES];
static uint8_t bits[VALUES];

static double along(double distance_m, double pitch_m, int64_t last, int64_t *index)
{
    double millionths = rint(distance_m / pitch_m * 1e6);
    *index = 0;
    if (millionths <= 0) return 0;
    *index = (int64_t)(millionths / 1e6);
    if (*index < last) return (double)((int64_t)millionths % 1000000) * 1e-6;
    *index = last;
    return 0;
}

/* Response of a point; the sum of its absolute values. */
static int64_t interpolate(const struct bank *b, double x_m, double y_m, int16_t *out)
{
    int64_t ix, iy, norm = 0;
    double right = along(x_m - b->x0_m, b->pitch_m, b->nx - 1, &ix), up = along(y_m - b->y0_m, b->pitch_m, b->ny - 1, &iy);
    double share[4] = {(1 - up) * (1 - right), (1 - up) * right, up * (1 - right), up * right}, total = 0;
    const int8_t *from[4];
    int16_t weight[4];
    int cells = 0;
    for (int corner = 0; corner < 4; corner++) {
        if (share[corner] == 0) continue;
        int32_t entry = b->entry_of[(iy + (corner >> 1)) * b->nx + ix + (corner & 1)];
        from[cells] = b->response + entry * b->stride;
        share[cells] = share[corner] * b->scale_of[entry];
        total += share[cells++];
    }
    for (int i = 0; i < cells; i++) weight[i] = (int16_t)rint(share[i] * (256 / total));
    if (cells == 1) weight[0] = 256;
    const int8_t *p = from[0], *q = from[1 % cells], *r = from[2 % cells], *s = from[3 % cells];
    if (cells == 1)
        for (int v = 0; v < VALUES; v++) out[v] = (int16_t)(p[v] * weight[0]);
    else if (cells == 2)
        for (int v = 0; v < VALUES; v++) out[v] = (int16_t)(p[v] * weight[0]) + (int16_t)(q[v] * weight[1]);
    else
        for (int v = 0; v < VALUES; v++)
            out[v] = (int16_t)(p[v] * weight[0]) + (int16_t)(q[v] * weight[1]) + (int16_t)(r[v] * weight[2]) + (int16_t)(s[v] * weight[3]);
    for (int n = 0; n < SAMPLES; n++) {
        int32_t part = 0;
        for (int c = 0; c < CHANNELS; c++) part += abs(out[n * CHANNELS + c]);
        norm += part;
    }
    return norm;
}

static void compose(const struct bank *b, const double (*points)[2], int count, uint32_t *words)
{
    int64_t norm[POINTS];
    double shares = 0;
    int32_t least[CHANNELS]; /* that plays high: a sum of zero leaves the channel idle */
    for (int c = 0; c < CHANNELS; c++) least[c] = b->idle_word >> c & 1 ? 0 : 1;
    for (int i = 0; i < count; i++) {
        norm[i] = interpolate(b, points[i][0], points[i][1], response_of[i]);
        shares += 1.0 / (double)norm[i];
    }
    for (int i = 0; i < count; i++) {
        int16_t weight = (int16_t)rint(1.0 / (double)norm[i] * (32767 / shares));
        if (count == 1)
            for (int v = 0; v < VALUES; v++) sum_of[v] = response_of[0][v];
        else if (i == 0)
            for (int v = 0; v < VALUES; v++) sum_of[v] = weight * response_of[i][v];
        else
            for (int v = 0; v < VALUES; v++) sum_of[v] += weight * response_of[i][v];
    }
    for (int n = 0; n < SAMPLES; n++)
        for (int c = 0; c < CHANNELS; c++) bits[n * CHANNELS + c] = sum_of[n * CHANNELS + c] >= least[c];
    for (int n = 0; n < SAMPLES; n++) {
        uint64_t eights[4];
        uint32_t word = 0;
        memcpy(eights, bits + n * CHANNELS, sizeof eights);
        for (int k = 0; k < 4; k++) word |= (uint32_t)(eights[k] * 0x0102040810204080ULL >> 56) << 8 * k;
        words[n] = word;
    }
}

/* Compose, and say how many nanoseconds that took. */
int64_t compose_reference(const struct bank *b, const double (*points)[2], int count, uint32_t *words)
{
    struct timespec begin, end;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    compose(b, points, count, words);
    clock_gettime(CLOCK_MONOTONIC, &end);
    return (end.tv_sec - begin.tv_sec) * 1000000000LL + end.tv_nsec - begin.tv_nsec;
}
