/* What composing at full amplitude costs in plain C: loops as they are written down, made into vectors of 128 bits by the compiler.
   It has nothing of the product's kernel; it gives the same words. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { CHANNELS = 32, SAMPLES = 1000, VALUES = SAMPLES * CHANNELS, RESTS = VALUES / 2, POINTS = 10, APART = 4 * CHANNELS };
enum { STEP = 3, SKETCH = (SAMPLES + STEP - 1) / STEP * CHANNELS }; /* a sketch: samples 0, 3, 6, .. */

struct bank {
    const int8_t *response;
    const int32_t *entry_of;
    const float *scale_of;
    int64_t stride, nx, ny;
    double pitch_m, x0_m, y0_m, equaliser, band_lost;
    uint32_t idle_word;
};

static int16_t response_of[POINTS][VALUES], whole_of[POINTS][VALUES], sketch_of[POINTS][SKETCH];
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

/* The four cells around a place, with their shares along x and y; for many points six, so that waves of all directions lose alike.
   Returns a of the equaliser. */
static double cells_around(const struct bank *b, const double *place, int many, int64_t *column, int64_t *row, double *x, double *y)
{
    double right = along(place[0] - b->x0_m, b->pitch_m, b->nx - 1, column), up = along(place[1] - b->y0_m, b->pitch_m, b->ny - 1, row);
    double ax = right * (1 - right), ay = up * (1 - up), more = fabs(ax - ay) / 2, *wide = ax > ay ? y : x, beyond = ax > ay ? up : right;
    int64_t *first = ax > ay ? row : column, start, count = ax > ay ? b->ny : b->nx;
    x[0] = 1 - right, x[1] = right, x[2] = 0;
    y[0] = 1 - up, y[1] = up, y[2] = 0;
    start = beyond <= 0.5 ? *first - 1 : *first;
    if (!many || more <= 1.0 / 48 || start < 0 || start + 3 > count) return ax + ay;
    for (int i = 0; i < 6; i++) {
        int64_t cx = ax > ay ? *column + i % 2 : start + i % 3, cy = ax > ay ? start + i / 2 : *row + i / 3;
        if (cx >= b->nx || cy >= b->ny || b->entry_of[cy * b->nx + cx] < 0) return ax + ay;
    }
    *first = start;
    if (beyond <= 0.5)
        wide[0] = more, wide[1] = 1 - beyond - 2 * more, wide[2] = beyond + more;
    else
        wide[0] = 1 - beyond + more, wide[1] = beyond - 2 * more, wide[2] = more;
    return ax + ay + 2 * more;
}

/* Values of a response of a point. */
static void interpolate(const struct bank *b, const double *place, int many, int first, int values, int16_t *out)
{
    int64_t ix, iy;
    double x[3], y[3], share[6], total = 0, between = cells_around(b, place, many, &ix, &iy, x, y);
    const int8_t *from[6];
    int16_t weight[6];
    int cells = 0;
    for (int i = 0; i < 9; i++) {
        double part = y[i / 3] * x[i % 3];
        if (part == 0) continue;
        int32_t entry = b->entry_of[(iy + i / 3) * b->nx + ix + i % 3];
        from[cells] = b->response + entry * b->stride + first;
        share[cells] = part * b->scale_of[entry];
        total += share[cells++];
    }
    double kept = first ? 1 - b->band_lost * between : 1; /* of what is outside the band */
    for (int i = 0; i < cells; i++) weight[i] = (int16_t)rint(share[i] * ((cells == 6 ? 255 : 256) / total * kept));
    if (cells == 1) weight[0] = 256;
    const int8_t *p = from[0], *q = from[1 % cells], *r = from[2 % cells], *s = from[3 % cells], *t = from[4 % cells], *u = from[5 % cells];
    if (cells == 1)
        for (int v = 0; v < values; v++) out[v] = (int16_t)(p[v] * weight[0]);
    else if (cells == 2)
        for (int v = 0; v < values; v++) out[v] = (int16_t)(p[v] * weight[0]) + (int16_t)(q[v] * weight[1]);
    else
        for (int v = 0; v < values; v++)
            out[v] = (int16_t)(p[v] * weight[0]) + (int16_t)(q[v] * weight[1]) + (int16_t)(r[v] * weight[2]) + (int16_t)(s[v] * weight[3]);
    if (cells == 6)
        for (int v = 0; v < values; v++) out[v] += (int16_t)(t[v] * weight[4]) + (int16_t)(u[v] * weight[5]);
}

/* Negated in channels that idle high: a bit deviates from idle where the sum is positive. */
static void turn(int16_t *response, int rows, const int16_t *idles_high)
{
    for (int n = 0; n < rows; n++, response += CHANNELS)
        for (int c = 0; c < CHANNELS; c++) response[c] = (response[c] ^ -idles_high[c]) + idles_high[c];
}

/* Halved, with the band's slope given back: 8 us before and after; all that bits do; the sum of absolute values in the band. */
static int64_t equalise(const struct bank *b, const double *place, int many, int16_t *response, const int16_t *rest, int16_t *whole)
{
    static int16_t met[VALUES + 2 * APART];
    int64_t ix, iy, norm = 0;
    double x[3], y[3];
    int32_t tap = (int32_t)rint(b->equaliser * cells_around(b, place, many, &ix, &iy, x, y) * (1 << 14));
    memcpy(met + APART, response, VALUES * sizeof *met);
    for (int v = 0; v < VALUES; v++) response[v] = (int16_t)((met[v + APART] >> 1) - (met[v] * tap >> 15) - (met[v + 2 * APART] * tap >> 15));
    for (int v = 0; v < VALUES; v++) {
        int32_t both = response[v] + (rest[v / (2 * CHANNELS) * CHANNELS + v % CHANNELS] >> 1);
        whole[v] = (int16_t)(both > INT16_MAX ? INT16_MAX : both < INT16_MIN ? INT16_MIN : both);
    }
    for (int n = 0; n < SAMPLES; n++) {
        int32_t part = 0;
        for (int c = 0; c < CHANNELS; c++) part += abs(response[n * CHANNELS + c]);
        norm += part;
    }
    return norm;
}

static void sketch(const int16_t *response, int16_t *out)
{
    for (int n = 0; n < SAMPLES; n += STEP, out += CHANNELS)
        for (int c = 0; c < CHANNELS; c++) out[c] = response[n * CHANNELS + c] >> 4;
}

/* Polarities with the largest energy of the sum, from the sketches. */
static void find_polarities(const int64_t *norm, int count, int *sign)
{
    double product[POINTS][POINTS], largest = 0;
    int64_t whole[POINTS][POINTS] = {{0}}, most = INT64_MIN;
    int best = 0, negative = 0;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < i; j++) {
            int64_t sum = 0;
            for (int v = 0; v < SKETCH; v += CHANNELS) {
                int32_t part = 0;
                for (int k = v; k < v + CHANNELS; k++) part += sketch_of[i][k] * sketch_of[j][k];
                sum += part;
            }
            product[i][j] = (double)sum / (double)norm[i] / (double)norm[j];
            if (fabs(product[i][j]) > largest) largest = fabs(product[i][j]);
        }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < i; j++) whole[i][j] = (int64_t)rint(product[i][j] * ((1 << 30) / largest));
    for (int choice = 0; choice < 1 << (count - 1); choice++) {
        int64_t energy = 0;
        for (int i = 0; i < count; i++)
            for (int j = 0; j < i; j++) energy += (choice << 1 >> i & 1) == (choice << 1 >> j & 1) ? whole[i][j] : -whole[i][j];
        if (energy > most) {
            most = energy;
            best = choice;
        }
    }
    for (int i = 0; i < count; i++) negative += best << 1 >> i & 1;
    for (int i = 0; i < count; i++) sign[i] = (best << 1 >> i & 1) != (2 * negative > count) ? -1 : 1;
}

/* Whole weights of 15 bits. */
static void weigh(const double *divisor, const double *weight, int count, int16_t *whole)
{
    double total = 0;
    for (int i = 0; i < count; i++) total += fabs(weight[i] / divisor[i]);
    for (int i = 0; i < count; i++) whole[i] = (int16_t)rint(weight[i] / divisor[i] * (32767 / total));
}

static void add_up(const int16_t (*response)[VALUES], const int16_t *whole, int count)
{
    for (int i = 0; i < count; i++) {
        int16_t weight = whole[i];
        if (i == 0)
            for (int v = 0; v < VALUES; v++) sum_of[v] = weight * response[0][v];
        else
            for (int v = 0; v < VALUES; v++) sum_of[v] += weight * response[i][v];
    }
    for (int v = 0; v < VALUES; v++) bits[v] = sum_of[v] > 0;
}

/* Divide weights by what the points got. */
static void correct(const double *share, int count, double *weight)
{
    double mean = 0;
    for (int i = 0; i < count; i++) mean += share[i];
    mean /= count;
    for (int i = 0; i < count; i++) weight[i] *= share[i] > 0 ? fmin(fmax(mean / share[i], 0.5), 2) : 2;
}

/* Balance weights in the sketches, then with all that bits do. */
static void balance(const double *divisor, int count, double *weight)
{
    int16_t whole[POINTS], above[SKETCH];
    double share[POINTS];
    weigh(divisor, weight, count, whole);
    for (int i = 0; i < count; i++)
        if (i == 0)
            for (int v = 0; v < SKETCH; v++) sum_of[v] = whole[i] * sketch_of[i][v];
        else
            for (int v = 0; v < SKETCH; v++) sum_of[v] += whole[i] * sketch_of[i][v];
    for (int v = 0; v < SKETCH; v++) above[v] = sum_of[v] > 0;
    for (int i = 0; i < count; i++) {
        int32_t got = 0; /* 10,688 values of 11 bits */
        for (int v = 0; v < SKETCH; v++) got += sketch_of[i][v] * above[v];
        share[i] = got / divisor[i];
    }
    correct(share, count, weight);
    for (int round = 0; round < (count > 4 ? 2 : 1); round++) {
        weigh(divisor, weight, count, whole);
        add_up(response_of, whole, count);
        for (int i = 0; i < count; i++) {
            int64_t got = 0;
            for (int n = 0; n < SAMPLES; n++) {
                int32_t part = 0;
                for (int v = n * CHANNELS; v < (n + 1) * CHANNELS; v++) part += whole_of[i][v] * bits[v];
                got += part;
            }
            share[i] = (double)got / divisor[i];
        }
        correct(share, count, weight);
    }
}

static void compose(const struct bank *b, const double (*points)[2], int count, uint32_t *words)
{
    int64_t norm[POINTS] = {1};
    double divisor[POINTS], weight_of[POINTS];
    static int16_t rest[RESTS];
    int16_t whole[POINTS], idles_high[CHANNELS];
    int sign[POINTS] = {1};
    for (int c = 0; c < CHANNELS; c++) idles_high[c] = b->idle_word >> c & 1;
    for (int i = 0; i < count; i++) {
        interpolate(b, points[i], count > 4, 0, VALUES, response_of[i]);
        turn(response_of[i], SAMPLES, idles_high);
        if (count == 1) continue;
        interpolate(b, points[i], count > 4, VALUES, RESTS, rest);
        turn(rest, SAMPLES / 2, idles_high);
        norm[i] = equalise(b, points[i], count > 4, response_of[i], rest, whole_of[i]);
        sketch(response_of[i], sketch_of[i]);
    }
    if (count > 1) find_polarities(norm, count, sign);
    for (int i = 0; i < count; i++) {
        divisor[i] = sign[i] * (double)norm[i];
        weight_of[i] = 1;
    }
    if (count > 1) {
        balance(divisor, count, weight_of);
        weigh(divisor, weight_of, count, whole);
        add_up(response_of, whole, count);
    } else
        for (int v = 0; v < VALUES; v++) bits[v] = response_of[0][v] > 0;
    for (int n = 0; n < SAMPLES; n++) {
        uint64_t eights[4];
        uint32_t word = 0;
        memcpy(eights, bits + n * CHANNELS, sizeof eights);
        for (int k = 0; k < 4; k++) word |= (uint32_t)(eights[k] * 0x0102040810204080ULL >> 56) << 8 * k;
        words[n] = word ^ b->idle_word;
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
