/* The compiled kernel: points to drive words, drive words to LOAD frames; and a program's start, without waiting for it.

   Its specification is words_twin.py, compact_twin.py and twin.py, which do the same in NumPy and Python: the same whole numbers, to the bit, and where
   weights and thresholds are set the same IEEE double arithmetic in the same order (so: no contraction to fused operations, no library
   functions). Buffers are the caller's; nothing is allocated, no Python object is touched in loops. Plain loops of a fixed length and
   vectors of 128 bits, of which compilers make SSE2 and NEON alike; of 256 bits for AVX2, in a module of its own. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <fcntl.h>
#include <float.h>
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <string.h>
#ifdef __linux__
#include <sys/syscall.h>
#include <unistd.h>
#endif
#ifdef __SSE2__
#include <immintrin.h>
#elif defined __ARM_NEON
#include <arm_neon.h>
#endif
#if defined __aarch64__ && defined __linux__
#include <sys/auxv.h>
#define MACHINE_HAS_CRC (getauxval(AT_HWCAP) >> 7 & 1) /* HWCAP_CRC32: every Raspberry Pi of 64 bits */
#else
#define MACHINE_HAS_CRC 0
#endif

#ifdef __x86_64__
#define MACHINE_HAS_AVX2 !!__builtin_cpu_supports("avx2")
#else
#define MACHINE_HAS_AVX2 0
#endif

#ifdef FOR_AVX2 /* a module beside the one for all processors */
#define MODULE "controller.device.kernel._kernel_avx2"
#define INITIALISE PyInit__kernel_avx2
#else
#define MODULE "controller.device.kernel._kernel"
#define INITIALISE PyInit__kernel
#endif

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "words and levels are read as they lie in the bank: little-endian"
#endif
#if FLT_EVAL_METHOD != 0
#error "doubles have to be rounded after every operation"
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif /* GCC has it from its command line: -ffp-contract=off */

#define INLINE static inline __attribute__((always_inline))
#define APART static __attribute__((noinline)) /* so that loops are made into vectors one by one */

/* ---- words: numbers of words_twin.py ---- */

enum {
    CHANNELS = 32,
    REST_SAMPLES = 2,
    GROUP_SAMPLES = 8,
    MAX_FOCI = 10,
    MAX_SAMPLES = 2000,
    MAX_BLOCK_SAMPLES = 256,
    WEIGHT_SUM = 256,
    WIDE_CELLS = 6,
    POINT_WEIGHT_SUM = 32767,
    STRENGTH_SHIFT = 8,
    SKETCHED_PER_BLOCK = 16,
    SKETCH_SHIFT = 4,
    LARGEST_SKETCHED = 2047,
    PRODUCT_BITS = 30,
    THRESHOLD_BITS = 24,
    NEAR_LEVEL_SHIFT = 3,
    FEW_POINTS = 4,
    MAX_ROUNDS = 6,
    ROUNDS = 3,
    MAX_LOWERINGS = 3,
    FLIP_SWEEPS = 2,
    ROW = GROUP_SAMPLES * CHANNELS, /* values that are worked on at a time */
    LINE_BYTES = 64,
    STEPS_PER_BLOCK = 12,
    AHEAD_BYTES = 1024,
};
static const double NEARLY = 0.03, FAR = 0.25, CLOSE = 0.002, MAX_CORRECTION = 2.0, TOO_MUCH = 1.03, ONE_PLACE = 0.5, RATIO_SLOPE = 100.0, OWN_LEVEL = 1.0 / 8, FAINT = 1.0 / 3, NEAR_STRENGTHS = 1.0 / 32, LEAST_MORE = 1.0 / 48;
static const double THRESHOLDS[] = {0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 3.0};
static const double SHARES[] = {1.0, 0.9764, 0.9089, 0.8022, 0.6727, 0.5347, 0.3991, 0.2781, 0.155, 0.067};
static const double LEAST_AMPLITUDE = 1.0 / 1024; /* words_twin.py */
static const double LARGEST_EQUALISER = 0.5;      /* bank_twin.py */
static const double ONES[MAX_FOCI] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
enum { SHARES_GIVEN = sizeof SHARES / sizeof *SHARES };

struct plan {
    int64_t samples, stride, nx, ny, entries, idle_word, block_samples;
    double pitch_m, x0_m, y0_m, equaliser, band_lost;
};

/* ---- words: numbers of compact_twin.py ---- */

enum {
    TABLES_AT = 128,
    LOUDEST = 15,
    SHARE_SUM = 2130,
    TAP_BITS = 15,
    EVEN_BEYOND = 2,
    MIN_ACROSS = 2,
    MAX_ACROSS = 6,
    MAX_CELLS = MAX_ACROSS * MAX_ACROSS,
    MAX_WEIGHTS = 1024,
    MAX_TAPS = 16,
    MAX_STEPS = 64,
    MAX_APART = 256,
    LARGEST_OF_BAND = 24000,
    MAX_EVEN = MAX_SAMPLES / 2 + EVEN_BEYOND,
};

/* Of the band, or of what it leaves out: how cells are summed around a place, and their sum becomes outputs. */
struct layer {
    int32_t across, steps, weights, block_rows, taps;
    int64_t outputs, half, row_bytes; /* samples, or rows of the rest; steps of a stencil up to its middle */
    const uint8_t *stencil, *pulses;  /* 16 bits each, of any alignment */
};

struct tables {
    int there; /* whether the bank is a compact one */
    struct layer in_band, rest;
    int32_t odd_near, odd_far, rest_nx, rest_ny;
    int32_t apart, own, outer;  /* of the rest's part that is made of the band: samples between its own two and the outer, taps of both sums */
    double pitch_m, x0_m, y0_m; /* of the rest */
    const uint8_t *rest_scales, *rest_rows;
};

struct bank {
    struct plan plan;
    struct tables tables;
    Py_ssize_t response_bytes;
    const uint8_t *entries, *scales, *good, *response;
};

/* Cells around a point; of the rest outside the band only the weights are others. Of a compact bank, they are `across` to a row, the
   rest has its own, and they have shares in place of weights. */
struct patch {
    const uint8_t *levels[MAX_CELLS], *rest[MAX_CELLS];
    int16_t weight[MAX_CELLS], rest_weight[MAX_CELLS];
    int cells, rests;
    int16_t tap;                 /* of the equaliser; 0: none */
    const struct tables *tables; /* of a compact bank, else 0 */
};

/* Values lie in the order of channels 0, 2, .., 14, 1, 3, .., 15 and the same from 16 on: as 16 bytes fall into halves of 16 bits. */
struct work {
    int count;
    int64_t values, rests, rows, block_rows, blocks; /* values of a response in the band, outside it; rows of eight samples, in a block too; blocks */
    int64_t step, sketch_step; /* samples between the taps of an equaliser, and those of a sketch */
    uint32_t idle_word;
    int16_t *response[MAX_FOCI], *rest[MAX_FOCI]; /* in the band and beyond, with room for a whole last row */
    int32_t *strength, *threshold, *near_low, *near_high; /* of each block and channel; between the last two, sums are near their threshold */
    int16_t *threshold_of_one;
    uint32_t *near; /* of each sample: channels whose sums are near their threshold */
    int16_t *sketch[MAX_FOCI]; /* some samples of a response */
    int64_t sketch_rows; /* of eight samples */
    uint32_t *words;
    double divisor[MAX_FOCI], balance[MAX_FOCI], measured[MAX_FOCI], in_band[MAX_FOCI], wanted[MAX_FOCI];
};

#ifdef __AVX2__
enum { LANES = 16 };
#else
enum { LANES = 8 };
#endif
enum { PARTS = CHANNELS / LANES };
typedef int16_t shorts __attribute__((vector_size(2 * LANES)));
typedef uint16_t ushorts __attribute__((vector_size(2 * LANES)));
typedef uint32_t uints __attribute__((vector_size(2 * LANES)));

/* Instructions that both widths have: on halves of 128 bits, one beside the other. */
#ifdef __AVX2__
typedef __m256i machine;
#define X86(name) _mm256_##name
#elif defined __SSE2__
typedef __m128i machine;
#define X86(name) _mm_##name
#endif

INLINE ushorts load(const void *from) {
    ushorts read;
    memcpy(&read, from, sizeof read);
    return read;
}

INLINE void store(void *to, ushorts value) { memcpy(to, &value, sizeof value); }

INLINE ushorts at_odd(ushorts levels) { return (ushorts)((shorts)levels >> 8); }

INLINE ushorts at_even(ushorts levels) { return (ushorts)((shorts)(levels << 8) >> 8); }

INLINE ushorts positive(ushorts value) { return (ushorts)((shorts)value > 0); }

/* Halves of 128 bits in the order of values: first those of the lower halves, then those of the upper. */
INLINE void put_in_order(ushorts *first, ushorts *second) {
#ifdef __AVX2__
    machine low = (machine)*first, high = (machine)*second;
    *first = (ushorts)_mm256_permute2x128_si256(low, high, 0x20);
    *second = (ushorts)_mm256_permute2x128_si256(low, high, 0x31);
#else
    (void)first, (void)second;
#endif
}

#ifndef __SSE2__
/* Halves of 16 bits, all ones or zero, to the bits of 16 channels. */
INLINE uint32_t bits_of(ushorts even, ushorts odd) {
    ushorts lower = (ushorts){0} + 0xff, bytes = (even & lower) | (odd & ~lower);
    union {
        ushorts vector;
        uint64_t eight[2];
    } bits = {.vector = bytes & 0x0101};
    uint64_t packing = 0x0102040810204080u; /* moves the lowest bits of eight bytes to the highest byte */
    return (uint32_t)(bits.eight[0] * packing >> 56 | bits.eight[1] * packing >> 56 << 8);
}
#endif

/* Bits of the channels whose values are above zero; of values that are all ones or zero, or not above: of all that are ones. */
INLINE uint32_t word_of(const ushorts *value, int above) {
#ifdef __SSE2__
#ifdef __AVX2__
    machine both = _mm256_packs_epi16((machine)value[0], (machine)value[1]);
    __m128i even = _mm256_castsi256_si128(both), odd = _mm256_extracti128_si256(both, 1);
#else
    __m128i even = _mm_packs_epi16((machine)value[0], (machine)value[2]), odd = _mm_packs_epi16((machine)value[1], (machine)value[3]);
#endif
    __m128i low = _mm_unpacklo_epi8(even, odd), high = _mm_unpackhi_epi8(even, odd), zero = _mm_setzero_si128();
    if (above) low = _mm_cmpgt_epi8(low, zero), high = _mm_cmpgt_epi8(high, zero);
    return (uint32_t)_mm_movemask_epi8(low) | (uint32_t)_mm_movemask_epi8(high) << 16;
#else
    ushorts four[PARTS];
    for (int part = 0; part < PARTS; part++) four[part] = above ? positive(value[part]) : value[part];
    return bits_of(four[0], four[1]) | bits_of(four[2], four[3]) << 16;
#endif
}

/* All ones for a channel that idles high, by which a value is negated; else 0. */
INLINE uint16_t turned(uint32_t idle_word, int channel) { return (uint16_t) - (idle_word >> channel & 1); }

/* Weights of cells for the channels at even and at odd places of what is read at a time; of channels that idle high they are negated. */
INLINE void turn_weights(uint32_t idle_word, int cells, const int16_t *weights, ushorts (*weight)[PARTS]) {
    for (int part = 0; part < PARTS; part++) {
        ushorts turn;
        for (int lane = 0; lane < LANES; lane++) turn[lane] = turned(idle_word, part / 2 * 2 * LANES + 2 * lane + part % 2);
        for (int cell = 0; cell < cells; cell++) weight[cell][part] = (((ushorts){0} + (uint16_t)weights[cell]) ^ turn) - turn;
    }
}

INLINE void interpolate_sample(const struct patch *patch, int cells, int64_t at, const ushorts (*weight)[PARTS], ushorts *value) {
    for (int part = 0; part < PARTS; part += 2) {
        ushorts even = {0}, odd = {0};
        for (int cell = 0; cell < cells; cell++) {
            ushorts levels = load(patch->levels[cell] + at + LANES * part);
            if (!part) __builtin_prefetch(patch->levels[cell] + at + AHEAD_BYTES); /* the machine does not look beyond a page */
            even += at_even(levels) * weight[cell][part];
            odd += at_odd(levels) * weight[cell][part + 1];
        }
        put_in_order(&even, &odd);
        value[part] = even;
        value[part + 1] = odd;
    }
}

/* Words of a single point at full amplitude. */
INLINE void sign_of(struct work *work, const struct patch *patch, int cells) {
    ushorts weight[4][PARTS], value[PARTS];
    turn_weights(work->idle_word, cells, patch->weight, weight);
    for (int64_t at = 0; at < work->values; at += CHANNELS) {
        interpolate_sample(patch, cells, at, (const ushorts(*)[PARTS])weight, value);
        work->words[at / CHANNELS] = word_of(value, 1) ^ work->idle_word;
    }
}

INLINE uints add_absolute(uints sum, ushorts value) {
    ushorts sign = (ushorts)((shorts)value >> 15);
#ifdef __SSE2__
    return sum + (uints)X86(madd_epi16)((machine)value, (machine)(sign | 1));
#else
    uints two = (uints)((value ^ sign) - sign); /* an equalised value is above -2^15 */
    return sum + (two >> 16) + (two & 0xffff);
#endif
}

INLINE int64_t sum_of(uints sums) {
    int64_t sum = 0;
    for (int lane = 0; lane < LANES / 2; lane++) sum += (int32_t)sums[lane];
    return sum;
}

/* Values of a response of a point, negated in channels that idle high; or half of what is outside the band: `outside` is 0 or 1. */
INLINE void interpolate_cells(uint32_t idle_word, const struct patch *patch, int cells, int outside, int64_t from, int64_t values, int16_t *out) {
    ushorts weight[WIDE_CELLS][PARTS], value[PARTS];
    turn_weights(idle_word, cells, outside ? patch->rest_weight : patch->weight, weight);
    for (int64_t at = 0; at < values; at += CHANNELS) {
        interpolate_sample(patch, cells, from + at, (const ushorts(*)[PARTS])weight, value);
        for (int part = 0; part < PARTS; part++) store(out + at + LANES * part, (ushorts)((shorts)value[part] >> outside));
    }
}

/* Products with a tap of less than 2^14, 15 bits of which are dropped. */
INLINE ushorts high(ushorts value, int16_t tap) {
#ifdef __SSE2__
    return (ushorts)X86(mulhi_epi16)((machine)value, X86(set1_epi16)((int16_t)(2 * tap)));
#elif defined __ARM_NEON
    return (ushorts)vqdmulhq_n_s16((int16x8_t)value, tap);
#else
    shorts product;
    for (int lane = 0; lane < 8; lane++) product[lane] = (int16_t)((int32_t)(int16_t)value[lane] * tap >> TAP_BITS);
    return (ushorts)product;
#endif
}

/* ---- words: responses of a compact bank: eight values at a time, as a row of numbers of four bits becomes four times eight ---- */

typedef uint16_t eights __attribute__((vector_size(16)));

INLINE eights load_eight(const void *from) {
    eights read;
    memcpy(&read, from, sizeof read);
    return read;
}

INLINE int16_t read_16(const uint8_t *from, int64_t index) {
    int16_t read;
    memcpy(&read, from + 2 * index, sizeof read);
    return read;
}

#ifdef __SSE2__
enum { DOUBLED = 1 }; /* taps are kept doubled, as the instruction drops 16 bits */
#else
enum { DOUBLED = 0 };
#endif

/* Products with a tap of less than 2^14 for each lane, 15 bits of which are dropped. */
INLINE eights high_each(eights value, eights taps) {
#ifdef __SSE2__
    return (eights)_mm_mulhi_epi16((__m128i)value, (__m128i)taps);
#elif defined __ARM_NEON
    return (eights)vqdmulhq_s16((int16x8_t)value, (int16x8_t)taps);
#else
    eights product;
    for (int lane = 0; lane < 8; lane++) product[lane] = (uint16_t)((int32_t)(int16_t)value[lane] * (int16_t)taps[lane] >> TAP_BITS);
    return product;
#endif
}

/* Scales of a cell's channels times its share, negated in channels that idle high. */
APART void scale_channels(int16_t *restrict scaled, int16_t *restrict driven, const uint8_t *restrict base, const int16_t *restrict turn, int16_t share) {
    int16_t eightfold = (int16_t)(share * 8);
    for (int i = 0; i < CHANNELS; i++) {
        int16_t one = (int16_t)((int32_t)eightfold * (int16_t)(base[i] << 7) >> 16);
        driven[i] |= one;
        scaled[i] = (int16_t)((one ^ turn[i]) - turn[i]);
    }
}

/* Weights of a cell's numbers in a block, doubled, as numbers are half of the level above the lowest; their sums. */
INLINE void block_weights(eights *weight, eights *sum, const uint8_t *parts, const eights *scaled) {
    enum { UP = TAP_BITS - 6 + DOUBLED }; /* 6 bits of products are dropped */
    eights four = load_eight(parts), mask = (eights){0} + (LOUDEST << UP), one = (eights){0} + (1 << UP);
    eights taps[4] = {(four << UP & mask) + one, (four << (UP - 4) & mask) + one, (four << (UP - 8) & mask) + one, (four >> (12 - UP) & mask) + one};
    for (int part = 0; part < 4; part++) {
        eights of_block = high_each(scaled[part], taps[part]);
        sum[part] += of_block;
        weight[part] = of_block + of_block;
    }
}

INLINE void add_numbers(eights *sum, eights numbers, const eights *weight) {
    eights fifteen = (eights){0} + 15;
    sum[0] += (numbers & fifteen) * weight[0];
    sum[1] += (numbers >> 4 & fifteen) * weight[1];
    sum[2] += (numbers >> 8 & fifteen) * weight[2];
    sum[3] += (numbers >> 12) * weight[3];
}

/* Two rows of numbers at a time. */
APART void add_cells(eights *sum, int rows, const uint8_t *const *levels, int64_t at, const eights (*weight)[4], const eights *lowest, int cells) {
    int row = 0;
    for (; row + 1 < rows; row += 2, at += CHANNELS, sum += 8) {
        eights one[4], other[4];
        for (int part = 0; part < 4; part++) one[part] = other[part] = lowest[part];
        for (int cell = 0; cell < cells; cell++) {
            add_numbers(one, load_eight(levels[cell] + at), weight[cell]);
            add_numbers(other, load_eight(levels[cell] + at + CHANNELS / 2), weight[cell]);
        }
        memcpy(sum, one, sizeof one);
        memcpy(sum + 4, other, sizeof other);
    }
    if (row == rows) return;
    memcpy(sum, lowest, 4 * sizeof *sum);
    for (int cell = 0; cell < cells; cell++) add_numbers(sum, load_eight(levels[cell] + at), weight[cell]);
}

/* Weights of a place: the sum of its cells'. Channels in which any may not be 0 have a bit in `driven`. */
static void sum_weights(uint32_t idle_word, const struct layer *layer, const uint8_t *const *levels, const int16_t *share, int cells, eights *sum, int16_t *driven) {
    int bases = layer->weights * (CHANNELS / 2);
    eights scaled[MAX_CELLS][4], weight[MAX_CELLS][4];
    int16_t turn[CHANNELS];
    for (int i = 0; i < CHANNELS; i++) turn[i] = (int16_t)turned(idle_word, (i & 16) + (i & 7) * 2 + (i >> 3 & 1));
    for (int cell = 0; cell < cells; cell++) scale_channels((int16_t *)scaled[cell], driven, levels[cell] + bases, turn, share[cell]);
    for (int block = 0, row = 0; row < layer->weights; block++, row += layer->block_rows) {
        int left = layer->weights - row, rows = left < layer->block_rows ? left : layer->block_rows;
        eights together[4] = {{0}}, lowest[4];
        for (int cell = 0; cell < cells; cell++)
            block_weights(weight[cell], together, levels[cell] + bases + CHANNELS + block * (CHANNELS / 2), scaled[cell]);
        for (int part = 0; part < 4; part++) lowest[part] = (eights){0} - together[part] * LOUDEST;
        add_cells(sum + 4 * row, rows, levels, row * (CHANNELS / 2), (const eights(*)[4])weight, lowest, cells);
    }
}

/* Sums of the weights of a place, and what shifts of its outputs drop. */
struct weighed {
    const struct layer *layer;
    eights sum[4 * MAX_WEIGHTS], dropped[4];
};

INLINE const eights *first_weight(const eights *sum, const uint8_t *pulse, int last) {
    int first = read_16(pulse, 0);
    return sum + 4 * (first < 0 ? 0 : first < last ? first : last);
}

/* Eight taps, for `add_tap`. */
INLINE void prepare_taps(const uint8_t *from, eights *prepared) {
    eights taps = load_eight(from) << DOUBLED;
#ifdef __SSE2__
    prepared[0] = (eights)_mm_unpacklo_epi16((__m128i)taps, (__m128i)taps);
    prepared[1] = (eights)_mm_unpackhi_epi16((__m128i)taps, (__m128i)taps);
#else
    prepared[0] = taps;
#endif
}

/* Adds products with one of the taps, whose number is a constant. */
INLINE void add_tap(eights *total, const eights *from, const eights *prepared, int number) {
#ifdef __SSE2__
    __m128i four = (__m128i)prepared[number / 4];
    eights tap;
    switch (number % 4) {
    case 0: tap = (eights)_mm_shuffle_epi32(four, 0x00); break;
    case 1: tap = (eights)_mm_shuffle_epi32(four, 0x55); break;
    case 2: tap = (eights)_mm_shuffle_epi32(four, 0xAA); break;
    default: tap = (eights)_mm_shuffle_epi32(four, 0xFF);
    }
#else
    eights tap = (eights){0} + prepared[0][number];
#endif
    for (int part = 0; part < 4; part++) {
        total[part] += high_each(from[part], tap);
#ifdef __SSE2__
        __asm__("" : "+x"(total[part])); /* in this order: else products wait in memory */
#endif
    }
}

APART void outputs_of(const struct weighed *place, int64_t first, int64_t end, int16_t *out) {
    int taps = place->layer->taps, last = place->layer->weights - taps;
    const uint8_t *pulse = place->layer->pulses + 2 * first * (1 + taps);
    for (; first < end; first++, out += CHANNELS, pulse += 2 * (1 + taps)) {
        const eights *from = first_weight(place->sum, pulse, last);
        eights total[4];
        memcpy(total, place->dropped, sizeof total);
        for (int tap = 0; tap < taps; tap++, from += 4)
            for (int part = 0; part < 4; part++)
                total[part] += high_each(from[part], ((eights){0} + (uint16_t)read_16(pulse, 1 + tap)) << DOUBLED);
        memcpy(out, total, sizeof total);
    }
}

/* The same of four or eight taps, a constant; eight are read, as behind pulses lie other parts of the tables. */
INLINE void outputs_of_some(int taps, const struct weighed *place, int64_t first, int64_t end, int16_t *out) {
    int last = place->layer->weights - taps;
    const uint8_t *pulse = place->layer->pulses + 2 * first * (1 + taps);
    for (; first < end; first++, out += CHANNELS, pulse += 2 * (1 + taps)) {
        const eights *from = first_weight(place->sum, pulse, last);
        eights prepared[2], total[4];
        prepare_taps(pulse + 2, prepared);
        memcpy(total, place->dropped, sizeof total);
        add_tap(total, from + 0, prepared, 0);
        add_tap(total, from + 4, prepared, 1);
        add_tap(total, from + 8, prepared, 2);
        add_tap(total, from + 12, prepared, 3);
        if (taps == 8) {
            add_tap(total, from + 16, prepared, 4);
            add_tap(total, from + 20, prepared, 5);
            add_tap(total, from + 24, prepared, 6);
            add_tap(total, from + 28, prepared, 7);
        }
        memcpy(out, total, sizeof total);
    }
}

APART void outputs_of_four(const struct weighed *place, int64_t first, int64_t end, int16_t *out) { outputs_of_some(4, place, first, end, out); }

APART void outputs_of_eight(const struct weighed *place, int64_t first, int64_t end, int16_t *out) { outputs_of_some(8, place, first, end, out); }

static void weigh_place(uint32_t idle_word, const struct layer *layer, const uint8_t *const *levels, const int16_t *share, int cells, struct weighed *place) {
    int16_t driven[CHANNELS] = {0};
    place->layer = layer;
    sum_weights(idle_word, layer, levels, share, cells, place->sum, driven);
    for (int i = 0; i < CHANNELS; i++) driven[i] = driven[i] ? (int16_t)(layer->taps / 2) : 0; /* half of a bit for each tap */
    for (int part = 0; part < 4; part++) place->dropped[part] = load_eight(driven + 8 * part);
}

static void outputs(const struct weighed *place, int64_t first, int64_t end, int16_t *out) {
    switch (place->layer->taps) {
    case 4: outputs_of_four(place, first, end, out); break;
    case 8: outputs_of_eight(place, first, end, out); break;
    default: outputs_of(place, first, end, out);
    }
}

/* Some channels of a sample, between the even one that is given and the next; before the first one lie zeros. */
INLINE ushorts between(const int16_t *even, int16_t near, int16_t far) {
    ushorts inner = load(even) + load(even + CHANNELS), outer = load(even + 2 * CHANNELS) + load(even - CHANNELS);
    return (ushorts)((shorts)(inner + 1) >> 1) + high(inner, near) - high(outer, far);
}

enum { AT_A_TIME = 32, BESIDE = 1 + EVEN_BEYOND }; /* even samples, and those around them that odd ones lie between */

APART void words_between(const int16_t *even, int16_t near, int16_t far, uint32_t idle_word, int64_t samples, uint32_t *words) {
    ushorts value[PARTS];
    for (int64_t sample = 0; sample < samples; sample += 2, even += CHANNELS) {
        for (int part = 0; part < PARTS; part++) value[part] = load(even + LANES * part);
        words[sample] = word_of(value, 1) ^ idle_word;
        if (sample + 1 == samples) break;
        for (int part = 0; part < PARTS; part++) value[part] = between(even + LANES * part, near, far);
        words[sample + 1] = word_of(value, 1) ^ idle_word;
    }
}

/* Each value; returns the sums of absolute values. */
APART uints samples_between(const int16_t *even, int16_t near, int16_t far, int64_t samples, int16_t *out) {
    uints sum = {0};
    for (int64_t sample = 0; sample < samples; sample += 2, even += CHANNELS)
        for (int i = 0; i < CHANNELS; i += LANES) {
            ushorts value = load(even + i);
            store(out + sample * CHANNELS + i, value);
            sum = add_absolute(sum, value);
            if (sample + 1 == samples) continue;
            value = between(even + i, near, far);
            store(out + (sample + 1) * CHANNELS + i, value);
            sum = add_absolute(sum, value);
        }
    return sum;
}

/* The samples of a point: words, or else the response; of that the sum of absolute values is returned. */
static int64_t compact_samples(uint32_t idle_word, const struct patch *patch, int64_t samples, uint32_t *words, int16_t *out) {
    const struct layer *layer = &patch->tables->in_band;
    struct weighed place;
    int16_t even[(BESIDE + AT_A_TIME) * CHANNELS] = {0}, *first_even = even + CHANNELS;
    int16_t near = (int16_t)patch->tables->odd_near, far = (int16_t)patch->tables->odd_far;
    uints sum = {0};
    weigh_place(idle_word, layer, patch->levels, patch->weight, patch->cells, &place);
    outputs(&place, 0, EVEN_BEYOND, first_even);
    for (int64_t sample = 0; sample < samples; sample += 2 * AT_A_TIME) {
        int64_t left = samples - sample, now = left < 2 * AT_A_TIME ? left : 2 * AT_A_TIME, first = sample / 2 + EVEN_BEYOND;
        outputs(&place, first, first + now / 2, even + BESIDE * CHANNELS);
        if (words)
            words_between(first_even, near, far, idle_word, now, words + sample);
        else
            sum += samples_between(first_even, near, far, now, out + sample * CHANNELS);
        memcpy(even, even + AT_A_TIME * CHANNELS, BESIDE * CHANNELS * sizeof *even);
    }
    return sum_of(sum);
}

static void compact_rests(uint32_t idle_word, const struct patch *patch, int64_t rows, int16_t *out) {
    struct weighed place;
    weigh_place(idle_word, &patch->tables->rest, patch->rest, patch->rest_weight, patch->rests, &place);
    outputs(&place, 0, rows, out);
}

/* To rows of the rest what a slope leaves out within the band. */
APART void add_of_band(const struct tables *tables, const int16_t *response, int64_t values, int64_t rows, int16_t *out) {
    static const int16_t nothing[CHANNELS];
    int16_t own = (int16_t)tables->own, outer = (int16_t)tables->outer;
    int64_t apart = (int64_t)tables->apart * CHANNELS;
    for (int64_t row = 0, at = 0; row < rows; row++, at += REST_SAMPLES * CHANNELS, out += CHANNELS) {
        int64_t next = at + CHANNELS;
        const int16_t *a = response + at, *b = next < values ? response + next : nothing;
        const int16_t *before = at >= apart ? a - apart : nothing, *after = next + apart < values ? response + next + apart : nothing;
        for (int i = 0; i < CHANNELS; i += LANES) {
            ushorts inner = load(a + i) + load(b + i), beside = load(before + i) + load(after + i);
            ushorts dropped = (ushorts)((shorts)(inner | beside) != 0); /* half of a bit each, on average */
            store(out + i, load(out + i) + high(inner, own) + high(beside, outer) - dropped);
        }
    }
}

INLINE void interpolate(uint32_t idle_word, const struct patch *patch, int outside, int64_t from, int64_t values, int16_t *out) {
    switch (patch->cells) {
    case 1: interpolate_cells(idle_word, patch, 1, outside, from, values, out); break;
    case 2: interpolate_cells(idle_word, patch, 2, outside, from, values, out); break;
    case 4: interpolate_cells(idle_word, patch, 4, outside, from, values, out); break;
    default: interpolate_cells(idle_word, patch, WIDE_CELLS, outside, from, values, out);
    }
}

APART void interpolate_band(uint32_t idle_word, const struct patch *patch, int64_t values, int16_t *out) {
    interpolate(idle_word, patch, 0, 0, values, out);
}

APART void interpolate_rest(uint32_t idle_word, const struct patch *patch, int64_t from, int64_t values, int16_t *out) {
    interpolate(idle_word, patch, 1, from, values, out);
}

/* Half of a response less a share of itself `apart` values before and after; returns the sum of absolute values. */
APART int64_t equalise(const int16_t *restrict met, int64_t apart, int16_t tap, int64_t values, int16_t *restrict out) {
    uints sum = {0};
    for (int64_t at = 0; at < values; at += CHANNELS)
        for (int i = 0; i < CHANNELS; i += LANES) {
            const int16_t *from = met + at + i;
            ushorts value = (ushorts)((shorts)load(from) >> 1) - high(load(from - apart), tap) - high(load(from + apart), tap);
            store(out + at + i, value);
            sum = add_absolute(sum, value);
        }
    return sum_of(sum);
}

/* Response of a point, equalised, with some room for it; returns the sum of absolute values in the band. */
static int64_t respond(const struct work *work, const struct patch *patch, int16_t *response, int16_t *room) {
    int64_t apart = work->step * CHANNELS;
    int16_t *met = room + apart;
    if (patch->tables) return compact_samples(work->idle_word, patch, work->values / CHANNELS, NULL, response);
    memset(room, 0, (size_t)apart * sizeof *room);
    interpolate_band(work->idle_word, patch, work->values, met);
    memset(met + work->values, 0, (size_t)apart * sizeof *room);
    return equalise(met, apart, patch->tap, work->values, response);
}

/* Half of what bits do at a point outside the band, whose response is known. */
static void respond_outside(const struct work *work, const struct patch *patch, const int16_t *response, int16_t *rest) {
    if (patch->tables) {
        compact_rests(work->idle_word, patch, work->rests / CHANNELS, rest);
        if (patch->tables->own || patch->tables->outer) add_of_band(patch->tables, response, work->values, work->rests / CHANNELS, rest);
    } else
        interpolate_rest(work->idle_word, patch, work->values, work->rests, rest);
}

APART void compose_one(struct work *work, const struct patch *patch) {
    if (patch->tables) {
        compact_samples(work->idle_word, patch, work->values / CHANNELS, work->words, NULL);
        return;
    }
    switch (patch->cells) {
    case 1: sign_of(work, patch, 1); break;
    case 2: sign_of(work, patch, 2); break;
    default: sign_of(work, patch, 4);
    }
}

INLINE void store_sums(int32_t *to, uints low, uints high) {
    ushorts first = (ushorts)low, second = (ushorts)high;
    put_in_order(&first, &second);
    store(to, first);
    store(to + LANES / 2, second);
}

INLINE void load_sums(const int32_t *from, uints *low, uints *high) {
    ushorts first = load(from), second = load(from + LANES / 2);
    put_in_order(&first, &second); /* as they were: it changes places */
    *low = (uints)first;
    *high = (uints)second;
}

/* Adds values of two responses, each times its weight: of a pair that is repeated. */
INLINE void add_pair(uints *low, uints *high, ushorts a, ushorts b, ushorts pair) {
#ifdef __SSE2__
    *low += (uints)X86(madd_epi16)(X86(unpacklo_epi16)((machine)a, (machine)b), (machine)pair);
    *high += (uints)X86(madd_epi16)(X86(unpackhi_epi16)((machine)a, (machine)b), (machine)pair);
#elif defined __ARM_NEON
    int16x4_t two = vget_low_s16((int16x8_t)pair);
    *low = (uints)vmlal_lane_s16((int32x4_t)*low, vget_low_s16((int16x8_t)a), two, 0);
    *high = (uints)vmlal_lane_s16((int32x4_t)*high, vget_high_s16((int16x8_t)a), two, 0);
    *low = (uints)vmlal_lane_s16((int32x4_t)*low, vget_low_s16((int16x8_t)b), two, 1);
    *high = (uints)vmlal_lane_s16((int32x4_t)*high, vget_high_s16((int16x8_t)b), two, 1);
#else
    for (int lane = 0; lane < 4; lane++) {
        (*low)[lane] += (uint32_t)((int16_t)a[lane] * (int16_t)pair[0] + (int16_t)b[lane] * (int16_t)pair[1]);
        (*high)[lane] += (uint32_t)((int16_t)a[lane + 4] * (int16_t)pair[0] + (int16_t)b[lane + 4] * (int16_t)pair[1]);
    }
#endif
}

/* Where sums are positive: -1, else 0. */
INLINE ushorts above_zero(uints low, uints high) {
#ifdef __SSE2__
    return positive((ushorts)X86(packs_epi32)((machine)low, (machine)high));
#elif defined __ARM_NEON
    return positive((ushorts)vcombine_s16(vqmovn_s32((int32x4_t)low), vqmovn_s32((int32x4_t)high)));
#else
    ushorts above;
    for (int lane = 0; lane < 8; lane++) above[lane] = (uint16_t)-((int32_t)(lane < 4 ? low[lane] : high[lane - 4]) > 0);
    return above;
#endif
}

INLINE uints add_products(uints sum, ushorts a, ushorts b) {
#ifdef __SSE2__
    return sum + (uints)X86(madd_epi16)((machine)a, (machine)b);
#elif defined __ARM_NEON
    int32x4_t more = vmlal_s16((int32x4_t)sum, vget_low_s16((int16x8_t)a), vget_low_s16((int16x8_t)b));
    return (uints)vmlal_s16(more, vget_high_s16((int16x8_t)a), vget_high_s16((int16x8_t)b));
#else
    for (int lane = 0; lane < 8; lane++) sum[lane / 2] += (uint32_t)((int16_t)a[lane] * (int16_t)b[lane]);
    return sum;
#endif
}

/* Weights of the points in pairs; of an odd number the last one's is 0. */
INLINE void pair_weights(int count, const int16_t *weight, ushorts *pair) {
    for (int i = 0; i < count; i += 2) {
        uint32_t second = i + 1 < count ? (uint16_t)weight[i + 1] : 0;
        pair[i / 2] = (ushorts)((uints){0} + (second << 16 | (uint16_t)weight[i]));
    }
}

INLINE void add_points(int count, const ushorts *value, const ushorts *pair, uints *low, uints *high) {
    *low = *high = (uints){0};
    for (int i = 0; i < count; i += 2) add_pair(low, high, value[i], value[i + (i + 1 < count)], pair[i / 2]);
}

INLINE void load_points(int count, int16_t *const *response, int64_t at, ushorts *value) {
    for (int i = 0; i < count; i++) value[i] = load(response[i] + at);
}

INLINE void add_some(int count, int16_t *const *response, const int16_t *weight, int64_t at, int32_t *sum) {
    ushorts pair[(MAX_FOCI + 1) / 2], value[MAX_FOCI];
    pair_weights(count, weight, pair);
    for (int i = 0; i < ROW; i += LANES) {
        uints low, high;
        load_points(count, response, at + i, value);
        add_points(count, value, pair, &low, &high);
        store_sums(sum + i, low, high);
    }
}

/* What is given at each point where the weighted sum of the responses is positive: by its response, and by its rest, unless there is none. */
INLINE void measure_some(int count, int64_t rests, int16_t *const *response, int16_t *const *rest, const int16_t *weight, int64_t *in_band, int64_t *outside) {
    ushorts pair[(MAX_FOCI + 1) / 2], value[MAX_FOCI];
    uints given[MAX_FOCI] = {{0}}, beside[MAX_FOCI] = {{0}}, low, high;
    pair_weights(count, weight, pair);
    for (int64_t at = 0; at < rests; at += LANES) {
        int64_t first = at + (at & -CHANNELS) * (REST_SAMPLES - 1);
        ushorts both = {0};
        for (int sample = 0; sample < REST_SAMPLES; sample++) {
            load_points(count, response, first + sample * CHANNELS, value);
            add_points(count, value, pair, &low, &high);
            ushorts above = above_zero(low, high);
            for (int i = 0; i < count; i++) given[i] = add_products(given[i], value[i], above);
            both += above;
        }
        if (!rest) continue;
        for (int i = 0; i < count; i++) beside[i] = add_products(beside[i], load(rest[i] + at), both);
    }
    for (int i = 0; i < count; i++) {
        in_band[i] = -sum_of(given[i]);
        outside[i] = -sum_of(beside[i]);
    }
}

INLINE void write_some(int count, struct work *work, const int16_t *weight) {
    ushorts pair[(MAX_FOCI + 1) / 2], value[MAX_FOCI], above[PARTS];
    pair_weights(count, weight, pair);
    for (int64_t at = 0; at < work->values; at += CHANNELS) {
        for (int part = 0; part < PARTS; part++) {
            uints low, high;
            load_points(count, work->response, at + LANES * part, value);
            add_points(count, value, pair, &low, &high);
            above[part] = above_zero(low, high);
        }
        work->words[at / CHANNELS] = word_of(above, 0) ^ work->idle_word;
    }
}

/* A function for each number of points, so that they stay in registers. */
#define BY_COUNT(count, of) \
    switch (count) { \
    case 1: of(1); break; \
    case 2: of(2); break; \
    case 3: of(3); break; \
    case 4: of(4); break; \
    case 5: of(5); break; \
    case 6: of(6); break; \
    case 7: of(7); break; \
    case 8: of(8); break; \
    case 9: of(9); break; \
    default: of(10); \
    }

/* Sums of eight samples. */
APART void add_up(int count, int16_t *const *response, const int16_t *weight, int64_t at, int32_t *sum) {
#define ADD(count) add_some(count, response, weight, at, sum)
    BY_COUNT(count, ADD)
}

APART void measure_positive(int count, int64_t rests, int16_t *const *response, int16_t *const *rest, const int16_t *weight, int64_t *in_band, int64_t *outside) {
#define MEASURE_POSITIVE(count) measure_some(count, rests, response, rest, weight, in_band, outside)
    BY_COUNT(count, MEASURE_POSITIVE)
}

APART void write_positive(struct work *work, const int16_t *weight) {
#define WRITE_POSITIVE(count) write_some(count, work, weight)
    BY_COUNT(work->count, WRITE_POSITIVE)
}

/* Where sums are above their threshold: -1, else 0. */
APART void compare(int16_t *restrict above, const int32_t *restrict sum, const int32_t *restrict threshold) {
    for (int sample = 0; sample < GROUP_SAMPLES; sample++)
        for (int i = 0; i < CHANNELS; i++) above[CHANNELS * sample + i] = (int16_t)-(sum[CHANNELS * sample + i] > threshold[i]);
}

/* The same for a single point, whose sum is its response times a weight: against thresholds divided by that. */
APART void compare_one(int16_t *restrict above, const int16_t *restrict response, const int16_t *restrict threshold) {
    for (int sample = 0; sample < GROUP_SAMPLES; sample++)
        for (int i = 0; i < CHANNELS; i++) above[CHANNELS * sample + i] = (int16_t)-(response[CHANNELS * sample + i] > threshold[i]);
}

APART void compare_nothing(int16_t *restrict above, const int32_t *restrict sum) {
    for (int i = 0; i < ROW; i++) above[i] = (int16_t)-(sum[i] > 0);
}

/* Of values that are a multiple of the channels. */
APART int32_t inner_product(const int16_t *restrict a, const int16_t *restrict b, int values) {
#ifdef __SSE2__
    uints sums[PARTS] = {{0}}, all = {0};
    for (int i = 0; i < values; i += CHANNELS)
        for (int part = 0; part < PARTS; part++) sums[part] = add_products(sums[part], load(a + i + LANES * part), load(b + i + LANES * part));
    for (int part = 0; part < PARTS; part++) all += sums[part];
    return (int32_t)sum_of(all);
#else
    int32_t sum = 0;
    for (int i = 0; i < values; i++) sum += a[i] * b[i];
    return sum;
#endif
}

APART void add_strength(int32_t *restrict strength, const int32_t *restrict sum, int samples) {
    for (int sample = 0; sample < samples; sample++)
        for (int i = 0; i < CHANNELS; i++) {
            int32_t value = sum[CHANNELS * sample + i];
            strength[i] += (value < 0 ? -value : value) >> STRENGTH_SHIFT;
        }
}

INLINE uint32_t word_at(const int16_t *above) {
    ushorts value[PARTS];
    for (int part = 0; part < PARTS; part++) value[part] = load(above + LANES * part);
    return word_of(value, 0);
}

INLINE void write_words(const struct work *work, int64_t at, int samples, const int16_t *above) {
    for (int sample = 0; sample < samples; sample++)
        work->words[at / CHANNELS + sample] = word_at(above + CHANNELS * sample) ^ work->idle_word;
}

/* Where sums are above one bound and not above another. */
APART void compare_both(int16_t *restrict between, const int32_t *restrict sum, const int32_t *restrict low, const int32_t *restrict high) {
    for (int sample = 0; sample < GROUP_SAMPLES; sample++)
        for (int i = 0; i < CHANNELS; i++) {
            int32_t value = sum[CHANNELS * sample + i];
            between[CHANNELS * sample + i] = (int16_t)-((value > low[i]) & !(value > high[i]));
        }
}

static void note_near(const struct work *work, int64_t at, int samples, const int32_t *sum, int64_t block) {
    int16_t between[ROW];
    compare_both(between, sum, work->near_low + block, work->near_high + block);
    for (int sample = 0; sample < samples; sample++) work->near[at / CHANNELS + sample] = word_at(between + CHANNELS * sample);
}

/* ---- words: weights and thresholds ---- */

INLINE double nearest(double value) { return (value + 0x1.8p52) - 0x1.8p52; } /* whole number; of two the even one */

static double product(const double *left, const double *right, int count) {
    double total = 0;
    for (int i = 0; i < count; i++) total += left[i] * right[i];
    return total;
}

static double masking_threshold(double share) {
    for (int i = 1; i < SHARES_GIVEN; i++)
        if (share >= SHARES[i]) {
            double part = (SHARES[i - 1] - share > 0 ? SHARES[i - 1] - share : 0) / (SHARES[i - 1] - SHARES[i]);
            return THRESHOLDS[i - 1] + part * (THRESHOLDS[i] - THRESHOLDS[i - 1]);
        }
    return THRESHOLDS[SHARES_GIVEN - 1];
}

/* Whole numbers next to the weights, each times its balance, over the divisors, times what is returned. */
static double whole_weights(const struct work *work, const double *weights, int16_t *whole) {
    double share[MAX_FOCI], total = 0;
    for (int i = 0; i < work->count; i++) {
        share[i] = work->balance[i] * weights[i] / work->divisor[i];
        total += fabs(share[i]);
    }
    double unit = total > 0 && total < INFINITY ? POINT_WEIGHT_SUM / total : 0;
    for (int i = 0; i < work->count; i++) whole[i] = unit != 0 ? (int16_t)nearest(share[i] * unit) : 0;
    return unit;
}

enum { WRITE = 1, MEASURE = 2, STRENGTH = 4, NEAR = 8 };

/* Add what the bits of eight samples give at each point. */
static void measure_row(const struct work *work, int64_t at, const int16_t *above, int64_t *given) {
    int16_t both[ROW / REST_SAMPLES];
    for (int sample = 0; sample < GROUP_SAMPLES; sample += REST_SAMPLES)
        for (int i = 0; i < CHANNELS; i++)
            both[sample / REST_SAMPLES * CHANNELS + i] = (int16_t)(above[sample * CHANNELS + i] + above[(sample + 1) * CHANNELS + i]);
    for (int i = 0; i < work->count; i++)
        given[i] -= inner_product(work->response[i] + at, above, ROW) + inner_product(work->rest[i] + at / REST_SAMPLES, both, ROW / REST_SAMPLES);
}

/* Where the weighted sum is above its threshold: the words, what they give at each point, the strength of the sum, what is near. */
static void pass(struct work *work, const int16_t *weight, int to_do) {
    int32_t sum[ROW];
    int16_t above[ROW];
    int64_t given[MAX_FOCI] = {0};
    for (int64_t row = 0; row < work->rows; row++) {
        int64_t at = row * ROW, left = (work->values - at) / CHANNELS, block = row / work->block_rows * CHANNELS;
        int samples = left < GROUP_SAMPLES ? (int)left : GROUP_SAMPLES;
        if (to_do & (STRENGTH | NEAR) || work->count > 1) add_up(work->count, work->response, weight, at, sum);
        if (to_do & STRENGTH) add_strength(work->strength + block, sum, samples);
        if (to_do & NEAR) note_near(work, at, samples, sum, block);
        if (!(to_do & (WRITE | MEASURE))) continue;
        if (work->count > 1)
            compare(above, sum, work->threshold + block);
        else
            compare_one(above, work->response[0] + at, work->threshold_of_one + block);
        if (to_do & WRITE) write_words(work, at, samples, above);
        if (to_do & MEASURE) measure_row(work, at, above, given);
    }
    for (int i = 0; to_do & MEASURE && i < work->count; i++) work->measured[i] = (double)given[i] / work->divisor[i];
}

/* What the bits of full amplitude give at each point, whose thresholds are zero. */
static void measure_full(struct work *work, const int16_t *weight) {
    int64_t in_band[MAX_FOCI], outside[MAX_FOCI];
    measure_positive(work->count, work->rests, work->response, work->rest, weight, in_band, outside);
    for (int i = 0; i < work->count; i++) {
        work->measured[i] = (double)(in_band[i] + outside[i]) / work->divisor[i];
        work->in_band[i] = (double)in_band[i] / work->divisor[i];
    }
}

/* A threshold in local strengths, as a factor of those. */
static int64_t whole_scale(const struct work *work, double threshold) {
    double scale = threshold / (double)(work->block_rows * GROUP_SAMPLES) * (1 << THRESHOLD_BITS);
    return scale < INT32_MAX ? (int64_t)nearest(scale) : INT32_MAX;
}

INLINE int32_t level_of(int32_t strength, int64_t whole) {
    int64_t scaled = strength * whole >> (THRESHOLD_BITS - STRENGTH_SHIFT);
    return scaled < INT32_MAX ? (int32_t)scaled : INT32_MAX;
}

static void set_threshold(struct work *work, double threshold) {
    int64_t whole = whole_scale(work, threshold);
    for (int64_t i = 0; i < work->blocks * CHANNELS; i++) {
        work->threshold[i] = level_of(work->strength[i], whole);
        if (work->count > 1) continue;
        int32_t of_one = work->threshold[i] / POINT_WEIGHT_SUM; /* its only point has all of the weight */
        work->threshold_of_one[i] = of_one < INT16_MAX ? (int16_t)of_one : INT16_MAX;
    }
}

static void set_near(struct work *work) {
    int64_t whole = whole_scale(work, NEAR_STRENGTHS);
    for (int64_t i = 0; i < work->blocks * CHANNELS; i++) {
        int64_t level = work->threshold[i], aside = (level >> NEAR_LEVEL_SHIFT) + level_of(work->strength[i], whole);
        work->near_low[i] = level - aside > INT32_MIN ? (int32_t)(level - aside) : INT32_MIN;
        work->near_high[i] = level + aside < INT32_MAX ? (int32_t)(level + aside) : INT32_MAX;
    }
}

/* Whole weights and thresholds of weights; first ones: of those whose sum the strength is, with their unit. */
static void weigh(struct work *work, const double *now, const double *first, double first_unit, int again, int16_t *weight) {
    double scaled[MAX_FOCI], unit = first_unit, first_norm = sqrt(product(first, first, work->count));
    double norm = sqrt(product(now, now, work->count));
    if (norm == 0) norm = first_norm;
    if (again && work->count > 1) {
        for (int i = 0; i < work->count; i++) scaled[i] = now[i] * first_norm / norm;
        unit = whole_weights(work, scaled, weight);
    }
    set_threshold(work, masking_threshold(norm / sqrt(work->count)) * (unit / first_unit));
}

/* Add what is missing to the weights; from the second turn on by Anderson acceleration of depth one. */
static void step(const struct work *work, double gain, int turn, double *now, double *before, double *residual_before) {
    int count = work->count;
    double residual[MAX_FOCI], change[MAX_FOCI], mixing = 0;
    for (int i = 0; i < count; i++) {
        residual[i] = (work->wanted[i] - work->measured[i]) / gain;
        change[i] = residual[i] - residual_before[i];
    }
    if (turn) {
        double squared = product(change, change, count);
        mixing = squared > 0 ? product(residual, change, count) / squared : 0;
    }
    for (int i = 0; i < count; i++) {
        double further = now[i] + residual[i], old = before[i] + residual_before[i];
        before[i] = now[i];
        residual_before[i] = residual[i];
        now[i] = turn ? further + mixing * (old - further) : further;
    }
}

static double largest_size(const double *values, int count) {
    double largest = fabs(values[0]);
    for (int i = 1; i < count; i++)
        if (fabs(values[i]) > largest) largest = fabs(values[i]);
    return largest;
}

/* Weights that come next to what is wanted in some rounds, in the place of `best`, which are asked for; and what they give. */
static void come_near(struct work *work, const double *asked, int16_t *weight, double first_unit, double *best) {
    double now[MAX_FOCI], before[MAX_FOCI], residual_before[MAX_FOCI], best_measured[MAX_FOCI];
    double gain = 0, least = 0;
    memcpy(now, asked, sizeof now);
    memcpy(before, asked, sizeof before);
    memcpy(residual_before, asked, sizeof residual_before);
    for (int turn = 0; turn < MAX_ROUNDS; turn++) {
        weigh(work, now, asked, first_unit, turn, weight);
        pass(work, weight, MEASURE);
        double error[MAX_FOCI];
        for (int i = 0; i < work->count; i++) error[i] = work->wanted[i] > 0 ? (work->wanted[i] - work->measured[i]) / work->wanted[i] : 0;
        double squares = product(error, error, work->count);
        if (!turn || squares < least) {
            least = squares;
            memcpy(best, now, sizeof now);
            memcpy(best_measured, work->measured, sizeof best_measured);
        }
        if (largest_size(error, work->count) <= (turn + 1 < ROUNDS ? NEARLY : FAR)) break;
        if (gain == 0) gain = product(work->measured, now, work->count) / product(now, now, work->count);
        if (!(gain > 0)) break;
        step(work, gain, turn, now, before, residual_before);
    }
    memcpy(work->measured, best_measured, sizeof best_measured);
}

/* Flip a bit of a sample if errors, `missing`, become smaller by that. */
INLINE int flip_one(struct work *work, int64_t sample, int channel, const double *unit, double *missing) {
    int lane = (channel & 16) + (channel & 1) * 8 + (channel & 15) / 2, down = (work->words[sample] ^ work->idle_word) >> channel & 1;
    double change[MAX_FOCI], gained = 0, size = 0;
    for (int i = 0; i < work->count; i++) {
        int value = work->response[i][sample * CHANNELS + lane] + work->rest[i][sample / REST_SAMPLES * CHANNELS + lane];
        change[i] = (down ? -value : value) * unit[i];
        gained += missing[i] * change[i];
        size += change[i] * change[i];
    }
    if (!(gained > size)) return 0;
    work->words[sample] ^= 1u << channel;
    for (int i = 0; i < work->count; i++) missing[i] -= change[i];
    return 1;
}

/* Flip some of the bits that are near their threshold; returns the largest share that a point then gets of what is wanted. */
static double flip_near(struct work *work) {
    double unit[MAX_FOCI], missing[MAX_FOCI];
    for (int i = 0; i < work->count; i++) {
        unit[i] = work->wanted[i] > 0 ? 1 / (work->divisor[i] * work->wanted[i]) : 0;
        missing[i] = work->wanted[i] > 0 ? (work->wanted[i] - work->measured[i]) / work->wanted[i] : 0;
    }
    int close = largest_size(missing, work->count) <= CLOSE;
    for (int sweep = 0; sweep < FLIP_SWEEPS && !close; sweep++)
        for (int64_t sample = work->values / CHANNELS - 1; sample >= 0 && !close; sample--)
            for (uint32_t left = work->near[sample]; left && !close;) {
                int channel = 31 - __builtin_clz(left);
                left ^= 1u << channel;
                if (flip_one(work, sample, channel, unit, missing)) close = largest_size(missing, work->count) <= CLOSE;
            }
    double most = 1 - missing[0];
    for (int i = 1; i < work->count; i++)
        if (1 - missing[i] > most) most = 1 - missing[i];
    return most;
}

/* Words that give what is wanted; `weight` are whole weights next to what is asked times `first_unit`, of whose sum the strength is. */
static void solve(struct work *work, const double *asked, int16_t *weight, double first_unit) {
    double now[MAX_FOCI];
    come_near(work, asked, weight, first_unit, now);
    for (int lowering = 0; lowering <= MAX_LOWERINGS; lowering++) {
        weigh(work, now, asked, first_unit, 1, weight);
        set_near(work);
        pass(work, weight, lowering ? WRITE | NEAR | MEASURE : WRITE | NEAR);
        double most = flip_near(work);
        if (most <= TOO_MUCH) return;
        for (int i = 0; i < work->count; i++) {
            now[i] /= most;
            work->wanted[i] /= most;
        }
    }
}

/* ---- words: polarities and balance, from a sketch of the responses ---- */

APART void sketch_line(int16_t *restrict to, const int16_t *restrict from) {
    for (int i = 0; i < CHANNELS; i++) to[i] = (int16_t)(from[i] >> SKETCH_SHIFT);
}

/* The same of a compact bank, whose responses are too faint to lose bits. */
APART void sketch_faint_line(int16_t *restrict to, const int16_t *restrict from) {
    for (int i = 0; i < CHANNELS; i++) {
        int16_t value = from[i];
        value = value > LARGEST_SKETCHED ? LARGEST_SKETCHED : value;
        to[i] = value < -LARGEST_SKETCHED ? -LARGEST_SKETCHED : value;
    }
}

static void take_sketch(struct work *work, int faint) {
    int64_t samples = work->values / CHANNELS;
    for (int i = 0; i < work->count; i++) {
        int16_t *to = work->sketch[i], *end = to + work->sketch_rows * ROW;
        for (int64_t n = 0; n < samples; n += work->sketch_step, to += CHANNELS) (faint ? sketch_faint_line : sketch_line)(to, work->response[i] + n * CHANNELS);
        memset(to, 0, (size_t)(end - to) * sizeof *to);
    }
}

static int64_t sketched_product(const struct work *work, int i, int j) {
    int64_t sum = 0;
    for (int64_t at = 0; at < work->sketch_rows * ROW; at += ROW) sum += inner_product(work->sketch[i] + at, work->sketch[j] + at, ROW);
    return sum;
}

/* Ask for no more than points so near to each other can have. */
static void ask_alike(const struct work *work, int64_t (*gram)[MAX_FOCI], double *asked) {
    int changed = 1;
    double size[MAX_FOCI];
    for (int i = 0; i < work->count; i++) size[i] = (double)sketched_product(work, i, i);
    for (int turn = 0; changed && turn < work->count; turn++) {
        changed = 0;
        for (int i = 0; i < work->count; i++)
            for (int j = 0; j < i; j++) {
                if (!(size[i] > 0 && size[j] > 0)) continue;
                double together = (double)gram[i][j] / sqrt(size[i] * size[j]);
                if ((work->divisor[i] < 0) != (work->divisor[j] < 0)) together = -together;
                if (!(together > 0)) continue;
                double room = together < ONE_PLACE ? 1 + (ONE_PLACE - together) * RATIO_SLOPE : 1;
                if (asked[j] * room < asked[i]) asked[i] = asked[j] * room, changed = 1;
                if (asked[i] * room < asked[j]) asked[j] = asked[i] * room, changed = 1;
            }
    }
}

/* The points that are to be negative so that the energy of the sum is largest, a bit each. */
static uint32_t chosen(int count, double (*product)[MAX_FOCI], double largest) {
    double unit = (double)(1 << PRODUCT_BITS) / largest;
    int64_t whole[MAX_FOCI][MAX_FOCI], field[MAX_FOCI] = {0}, energy = 0, most;
    for (int i = 0; i < count; i++) {
        whole[i][i] = 0;
        for (int j = 0; j < i; j++) whole[i][j] = whole[j][i] = (int64_t)nearest(product[i][j] * unit);
    }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) field[i] += whole[i][j];
    for (int i = 0; i < count; i++) energy += field[i];
    most = energy;
    /* all choices, the first point positive, in the order of a Gray code: each turns one point; bit k is point k + 1 */
    uint32_t choice = 0, best = 0;
    for (uint32_t turn = 1; turn < 1u << (count - 1); turn++) {
        int bit = __builtin_ctz(turn), point = bit + 1, was_negative = choice >> bit & 1;
        choice ^= 1u << bit;
        energy += was_negative ? 4 * field[point] : -4 * field[point];
        for (int i = 0; i < count; i++) field[i] += was_negative ? 2 * whole[i][point] : -2 * whole[i][point];
        if (energy > most || (energy == most && choice < best)) {
            most = energy;
            best = choice;
        }
    }
    uint32_t negative = best << 1;
    return 2 * __builtin_popcount(best) > count ? ~negative : negative;
}

/* Negate the divisors of negative points; ask for what can be had. `polarity` of each point is given, or 0 and then filled. */
static void polarise(struct work *work, double *asked, int8_t *polarity) {
    int count = work->count, unlike = 0;
    int64_t gram[MAX_FOCI][MAX_FOCI];
    double product[MAX_FOCI][MAX_FOCI], largest = 0;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < i; j++) {
            gram[i][j] = sketched_product(work, i, j);
            product[i][j] = (double)gram[i][j] / work->divisor[i] / work->divisor[j];
            if (fabs(product[i][j]) > largest) largest = fabs(product[i][j]);
            unlike = unlike || asked[i] != asked[j];
        }
    if (!polarity[0]) {
        uint32_t negative = largest == 0 ? 0 : chosen(count, product, largest);
        for (int i = 0; i < count; i++) polarity[i] = negative >> i & 1 ? -1 : 1;
    }
    for (int i = 0; i < count; i++)
        if (polarity[i] < 0) work->divisor[i] = -work->divisor[i];
    if (unlike && largest != 0) ask_alike(work, gram, asked);
}

/* Divide weights by what the points got. */
static void correct_balance(struct work *work, const double *share) {
    double mean = 0, moving = 0;
    for (int i = 0; i < work->count; i++) {
        mean += share[i];
        moving += isfinite(work->divisor[i]);
    }
    mean /= moving > 0 ? moving : 1;
    for (int i = 0; i < work->count; i++) {
        double correction = share[i] > 0 ? mean / share[i] : MAX_CORRECTION;
        if (correction < 1 / MAX_CORRECTION) correction = 1 / MAX_CORRECTION;
        work->balance[i] *= correction < MAX_CORRECTION ? correction : MAX_CORRECTION;
    }
}

/* Weights with which all points get about the same share of their maximum in the sketch; 0 where there is nothing to be had. */
static void balance_sketch(struct work *work) {
    int count = work->count;
    int16_t whole[MAX_FOCI];
    int64_t got[MAX_FOCI], none[MAX_FOCI];
    double share[MAX_FOCI];
    for (int i = 0; i < count; i++) work->balance[i] = isfinite(work->divisor[i]);
    whole_weights(work, ONES, whole);
    measure_positive(count, work->sketch_rows * ROW / REST_SAMPLES, work->sketch, NULL, whole, got, none);
    for (int i = 0; i < count; i++) share[i] = (double)got[i] / work->divisor[i];
    correct_balance(work, share);
}

/* Displacements at less than full amplitude, from those at full amplitude, which were measured. */
static void set_wanted(struct work *work, const double *asked) {
    if (work->count == 1) {
        work->wanted[0] = asked[0] * work->measured[0];
        return;
    }
    double in_band = product(work->balance, work->in_band, work->count);
    if (!(in_band > 0)) in_band = INFINITY;
    double more = product(work->balance, work->measured, work->count) / in_band;
    double level = in_band / product(work->balance, ONES, work->count), nearly = level * OWN_LEVEL;
    for (int i = 0; i < work->count; i++) {
        double own = work->in_band[i] - level;
        if (own > nearly) own = nearly;
        if (own < -nearly) own = -nearly;
        work->wanted[i] = work->in_band[i] > 0 ? asked[i] * (work->in_band[i] - own) * more : 0;
    }
}

/* Compose; what is asked for and patches of `work->count` points. */
static void compose_points(struct work *work, const struct patch *patches, double *asked, int8_t *polarity) {
    int full = 1;
    int16_t weight[MAX_FOCI], weight_asked[MAX_FOCI];
    for (int i = 0; i < work->count; i++) full = full && asked[i] == 1;
    if (full && work->count == 1) {
        compose_one(work, patches);
        return;
    }
    for (int i = 0; i < work->count; i++) {
        int64_t norm = respond(work, patches + i, work->response[i], (int16_t *)work->strength);
        respond_outside(work, patches + i, work->response[i], work->rest[i]);
        work->divisor[i] = norm ? (double)norm : INFINITY;
        memset(work->response[i] + work->values, 0, (size_t)(work->rows * ROW - work->values) * sizeof(int16_t));
        memset(work->rest[i] + work->rests, 0, (size_t)(work->rows * ROW / REST_SAMPLES - work->rests) * sizeof(int16_t));
    }
    memset(work->threshold, 0, (size_t)(work->blocks * CHANNELS) * sizeof *work->threshold);
    memset(work->threshold_of_one, 0, (size_t)(work->blocks * CHANNELS) * sizeof *work->threshold_of_one);
    memset(work->strength, 0, (size_t)(work->blocks * CHANNELS) * sizeof *work->strength);
    work->balance[0] = 1;
    if (work->count > 1) {
        take_sketch(work, patches->tables != NULL);
        polarise(work, asked, polarity);
        balance_sketch(work);
    }
    if (whole_weights(work, ONES, weight) == 0) {
        pass(work, weight, WRITE);
        return;
    }
    double unit = whole_weights(work, asked, weight_asked);
    if (work->count == 1) {
        pass(work, weight, MEASURE | STRENGTH);
        set_wanted(work, asked);
    } else {
        measure_full(work, weight);
        if (!full) set_wanted(work, asked);
        if (full && work->count > FEW_POINTS) {
            correct_balance(work, work->measured);
            whole_weights(work, ONES, weight);
            measure_full(work, weight);
        }
        correct_balance(work, work->measured);
        unit = whole_weights(work, asked, weight_asked);
        if (full)
            write_positive(work, weight_asked);
        else
            pass(work, weight_asked, STRENGTH);
    }
    if (!full) solve(work, asked, weight_asked, unit);
}

/* Index of a row of cells and the distance beyond it, in pitches. */
static int64_t along(double distance_m, double pitch_m, int64_t last, double *beyond) {
    double millionths = distance_m / pitch_m * 1e6;
    *beyond = 0;
    if (!(millionths > 0)) return 0;
    if (millionths >= (double)last * 1e6) return last;
    int64_t whole = (int64_t)nearest(millionths);
    *beyond = (double)(whole % 1000000) * 1e-6;
    return whole / 1000000;
}

/* First cell of a stencil along an axis, and the steps of the place beyond it. */
static int64_t first_of(double distance_m, double pitch_m, int64_t count, const struct layer *layer, double *beyond) {
    double steps = distance_m / pitch_m * layer->steps, last = (double)((count - 1) * layer->steps);
    steps = steps > 0 ? steps < last ? steps : last : 0;
    int64_t first = ((int64_t)steps + (layer->across % 2 ? layer->steps / 2 : 0)) / layer->steps - (layer->across - 1) / 2;
    if (first < 0) first = 0;
    if (first > count - layer->across) first = count - layer->across;
    *beyond = steps - (double)(first * layer->steps);
    return first;
}

/* Adds some of the shares of the cells of a stencil around a step. */
static void add_shares(const struct layer *layer, int64_t x_steps, int64_t y_steps, double part, double *share) {
    int64_t all = (layer->across - 1) * layer->steps;
    int left = 2 * x_steps > all, down = 2 * y_steps > all, across = layer->across;
    int64_t at = ((down ? all - y_steps : y_steps) * layer->half + (left ? all - x_steps : x_steps)) * across * across;
    int rows = down ? -across : across, columns = left ? -1 : 1;
    at += (down ? (across - 1) * across : 0) + (left ? across - 1 : 0);
    for (int y = 0; y < across; y++, at += rows)
        for (int x = 0; x < across; x++) share[y * across + x] += part * read_16(layer->stencil, at + x * columns);
}

/* The shares of the cells of a stencil around a place: between those of the four steps around it. */
static void stencil_shares(const struct layer *layer, double x_steps, double y_steps, double *share) {
    int64_t last = (layer->across - 1) * layer->steps - 1, x = (int64_t)x_steps, y = (int64_t)y_steps;
    if (x > last) x = last;
    if (y > last) y = last;
    double right = x_steps - (double)x, up = y_steps - (double)y;
    memset(share, 0, (size_t)(layer->across * layer->across) * sizeof *share);
    add_shares(layer, x, y, (1 - up) * (1 - right), share);
    add_shares(layer, x + 1, y, (1 - up) * right, share);
    add_shares(layer, x, y + 1, up * (1 - right), share);
    add_shares(layer, x + 1, y + 1, up * right, share);
}

static double scaled(const uint8_t *scales, int64_t number, double *share, double *total) {
    float scale;
    memcpy(&scale, scales + 4 * number, sizeof scale);
    *share *= (double)scale;
    *total += fabs(*share);
    return (double)scale;
}

/* Whole weights; cells without any are left out. Returns how many remain. */
static int weigh_cells(const uint8_t **levels, int16_t *weight, const double *share, int cells, double unit) {
    int kept = 0;
    for (int i = 0; i < cells; i++) {
        weight[kept] = (int16_t)nearest(share[i] * unit);
        levels[kept] = levels[i];
        kept += weight[kept] != 0;
    }
    return kept;
}

static int32_t entry_of(const struct bank *bank, int64_t cell) {
    int32_t entry;
    memcpy(&entry, bank->entries + 4 * cell, sizeof entry);
    return entry;
}

/* As `find_patch`, of a compact bank. */
static int64_t find_stencil(const struct bank *bank, double x_m, double y_m, struct patch *patch) {
    const struct plan *plan = &bank->plan;
    const struct tables *tables = &bank->tables;
    double share[MAX_CELLS], rest_share[MAX_CELLS], total = 0, rest_total = 0;
    int64_t across = tables->in_band.across;
    double right, up;
    int64_t ix = first_of(x_m - plan->x0_m, plan->pitch_m, plan->nx, &tables->in_band, &right);
    int64_t iy = first_of(y_m - plan->y0_m, plan->pitch_m, plan->ny, &tables->in_band, &up);
    stencil_shares(&tables->in_band, right, up, share);
    patch->tables = tables;
    patch->tap = 0;
    patch->cells = (int)(across * across);
    for (int i = 0; i < patch->cells; i++) {
        int64_t cell = (iy + i / across) * plan->nx + ix + i % across;
        int32_t entry = entry_of(bank, cell);
        if (entry < 0 || entry >= plan->entries || !bank->good[entry]) return cell;
        if (entry * plan->stride + tables->in_band.row_bytes > bank->response_bytes) {
            PyErr_SetString(PyExc_ValueError, "the responses are too short for the plan");
            return -2;
        }
        patch->levels[i] = bank->response + entry * plan->stride;
        double scale = scaled(bank->scales, entry, share + i, &total);
        if (!(scale >= 0 && scale < INFINITY)) {
            PyErr_Format(PyExc_ValueError, "the scale of response %d is not finite, or below 0", (int)entry);
            return -2;
        }
    }
    across = tables->rest.across;
    ix = first_of(x_m - tables->x0_m, tables->pitch_m, tables->rest_nx, &tables->rest, &right);
    iy = first_of(y_m - tables->y0_m, tables->pitch_m, tables->rest_ny, &tables->rest, &up);
    stencil_shares(&tables->rest, right, up, rest_share);
    for (int i = 0; i < across * across; i++) {
        int64_t cell = (iy + i / across) * tables->rest_nx + ix + i % across;
        patch->rest[i] = tables->rest_rows + cell * tables->rest.row_bytes;
        scaled(tables->rest_scales, cell, rest_share + i, &rest_total);
    }
    double most = total > rest_total ? total : rest_total, unit = most > 0 && most < INFINITY ? SHARE_SUM / most : 0;
    patch->cells = weigh_cells(patch->levels, patch->weight, share, patch->cells, unit);
    patch->rests = weigh_cells(patch->rest, patch->rest_weight, rest_share, (int)(across * across), unit);
    return -1;
}

/* Cells along an axis around a place, and their shares. */
struct line {
    int64_t first;
    int cells;
    double share[3];
};

/* Those of a place beyond a cell by this share of a pitch; three of them, farther apart, where there is `more`. */
static struct line cells_along(int64_t cell, double beyond, double more) {
    if (!(more > 0)) return (struct line){cell, 2, {1 - beyond, beyond}};
    if (beyond <= 0.5) return (struct line){cell - 1, 3, {more, 1 - beyond - 2 * more, beyond + more}};
    return (struct line){cell, 3, {1 - beyond + more, beyond - 2 * more, more}};
}

/* Whether a bank has the responses of all cells of a rectangle. */
static int has_all(const struct bank *bank, const struct line *x, const struct line *y) {
    const struct plan *plan = &bank->plan;
    if (x->first < 0 || y->first < 0 || x->first + x->cells > plan->nx || y->first + y->cells > plan->ny) return 0;
    for (int i = 0; i < x->cells * y->cells; i++) {
        int32_t entry = entry_of(bank, (y->first + i / x->cells) * plan->nx + x->first + i % x->cells);
        if (entry < 0 || entry >= plan->entries) return 0;
    }
    return 1;
}

/* Responses around a point, with their weights. Returns -1; or the first cell without a response; or -2, with an exception. */
static int64_t find_patch(const struct bank *bank, double x_m, double y_m, int wide, struct patch *patch) {
    const struct plan *plan = &bank->plan;
    double right, up, share[WIDE_CELLS], total = 0;
    int64_t ix = along(x_m - plan->x0_m, plan->pitch_m, plan->nx - 1, &right);
    int64_t iy = along(y_m - plan->y0_m, plan->pitch_m, plan->ny - 1, &up);
    int64_t needed = (plan->samples + (plan->samples + REST_SAMPLES - 1) / REST_SAMPLES) * CHANNELS;
    if (bank->tables.there) return find_stencil(bank, x_m, y_m, patch);
    patch->cells = 0;
    patch->tables = NULL;
    double along_x = right * (1 - right), along_y = up * (1 - up), more = fabs(along_x - along_y) / 2, between = along_x + along_y;
    struct line x = cells_along(ix, right, along_y > along_x ? more : 0), y = cells_along(iy, up, along_x > along_y ? more : 0);
    if (wide && more > LEAST_MORE && has_all(bank, &x, &y)) {
        between += 2 * more;
    } else {
        x = cells_along(ix, right, 0);
        y = cells_along(iy, up, 0);
    }
    for (int i = 0; i < x.cells * y.cells; i++) {
        double part = y.share[i / x.cells] * x.share[i % x.cells];
        int64_t cell = (y.first + i / x.cells) * plan->nx + x.first + i % x.cells;
        float scale;
        if (part == 0) continue;
        int32_t entry = entry_of(bank, cell);
        if (entry < 0 || entry >= plan->entries || !bank->good[entry]) return cell;
        if (entry * plan->stride + needed > bank->response_bytes) {
            PyErr_SetString(PyExc_ValueError, "the responses are too short for the plan");
            return -2;
        }
        memcpy(&scale, bank->scales + 4 * (int64_t)entry, sizeof scale);
        if (!(scale >= 0 && scale < INFINITY)) {
            PyErr_Format(PyExc_ValueError, "the scale of response %d is not finite, or below 0", (int)entry);
            return -2;
        }
        patch->levels[patch->cells] = bank->response + entry * plan->stride;
        share[patch->cells] = part * (double)scale;
        total += share[patch->cells++];
    }
    double unit = total > 0 ? (WEIGHT_SUM - (patch->cells == WIDE_CELLS)) / total : 0, rest_unit = unit * (1 - plan->band_lost * between);
    for (int i = 0; i < patch->cells; i++) {
        patch->weight[i] = (int16_t)nearest(share[i] * unit);
        patch->rest_weight[i] = (int16_t)nearest(share[i] * rest_unit);
    }
    if (patch->cells == 1) patch->weight[0] = patch->rest_weight[0] = WEIGHT_SUM;
    patch->tap = (int16_t)nearest(plan->equaliser * between * (1 << (TAP_BITS - 1)));
    return -1;
}

/* ---- words: from Python ---- */

static int valid_layer(const struct layer *layer) {
    return layer->across >= MIN_ACROSS && layer->across <= MAX_ACROSS && layer->steps >= 2 && layer->steps <= MAX_STEPS && layer->steps % 2 == 0 &&
           layer->weights >= 1 && layer->weights <= MAX_WEIGHTS && layer->taps >= 1 && layer->taps <= MAX_TAPS && layer->taps <= layer->weights &&
           layer->block_rows >= 1 && layer->block_rows <= layer->weights;
}

/* Taps of less than 2^14, which with the rest's own share are within 16 bits. */
static int valid_of_band(const struct tables *tables) {
    int64_t own = tables->own < 0 ? -(int64_t)tables->own : tables->own, outer = tables->outer < 0 ? -(int64_t)tables->outer : tables->outer;
    return tables->apart >= 0 && tables->apart <= MAX_APART && own < 1 << 14 && outer < 1 << 14 && own + outer <= LARGEST_OF_BAND;
}

/* The next part of tables; 0 if there is none as long as that. */
static const uint8_t *take_part(const Py_buffer *buffer, int64_t *at, int64_t size) {
    if (size > buffer->len - *at) return NULL;
    const uint8_t *part = (const uint8_t *)buffer->buf + *at;
    *at += (size + LINE_BYTES - 1) / LINE_BYTES * LINE_BYTES;
    return part;
}

static int take_layer(struct layer *layer, int64_t outputs, const Py_buffer *buffer, int64_t *at) {
    layer->outputs = outputs;
    layer->half = (layer->across - 1) * layer->steps / 2 + 1;
    layer->row_bytes = (layer->weights + (layer->weights + layer->block_rows - 1) / layer->block_rows) * (CHANNELS / 2) + CHANNELS;
    layer->stencil = take_part(buffer, at, 2 * layer->half * layer->half * layer->across * layer->across);
    layer->pulses = layer->stencil ? take_part(buffer, at, 2 * outputs * (1 + layer->taps)) : NULL;
    return layer->pulses != NULL;
}

/* The tables of a compact bank, whose numbers of pulses were checked by `compact_twin.Tables`; 0 with an exception. */
static int take_tables(const Py_buffer *buffer, int64_t samples, struct tables *tables) {
    int32_t number[14], of_band[3];
    double place[3];
    int64_t at = TABLES_AT;
    tables->there = buffer->len > 0;
    if (!tables->there) return 1;
    if (buffer->len < TABLES_AT) {
        PyErr_SetString(PyExc_ValueError, "the tables of a compact bank are too short");
        return 0;
    }
    memcpy(number, buffer->buf, sizeof number);
    memcpy(place, (const uint8_t *)buffer->buf + sizeof number, sizeof place);
    memcpy(of_band, (const uint8_t *)buffer->buf + sizeof number + sizeof place, sizeof of_band);
    tables->in_band = (struct layer){.across = number[0], .steps = number[1], .weights = number[2], .block_rows = number[3], .taps = number[4]};
    tables->rest = (struct layer){.across = number[5], .steps = number[6], .weights = number[7], .block_rows = number[8], .taps = number[9]};
    tables->odd_near = number[10], tables->odd_far = number[11], tables->rest_nx = number[12], tables->rest_ny = number[13];
    tables->apart = of_band[0], tables->own = of_band[1], tables->outer = of_band[2];
    tables->pitch_m = place[0], tables->x0_m = place[1], tables->y0_m = place[2];
    int64_t rest = tables->rest.across, cells = (int64_t)tables->rest_nx * tables->rest_ny;
    if (!(valid_of_band(tables) && valid_layer(&tables->in_band) && valid_layer(&tables->rest) && number[10] >= 0 && number[10] < 1 << 14 && number[11] >= 0 &&
          number[11] < 1 << 14 && number[12] >= rest && number[12] < 1 << 15 && number[13] >= rest && number[13] < 1 << 15 &&
          place[0] > 0 && place[0] < INFINITY && isfinite(place[1]) && isfinite(place[2]))) {
        PyErr_SetString(PyExc_ValueError, "a number of the compact bank's tables is beyond its range");
        return 0;
    }
    if (take_layer(&tables->in_band, samples / 2 + EVEN_BEYOND, buffer, &at) &&
        take_layer(&tables->rest, (samples + REST_SAMPLES - 1) / REST_SAMPLES, buffer, &at) &&
        (tables->rest_scales = take_part(buffer, &at, 4 * cells)) && (tables->rest_rows = take_part(buffer, &at, cells * tables->rest.row_bytes)))
        return 1;
    PyErr_SetString(PyExc_ValueError, "the tables of a compact bank are too short");
    return 0;
}

static int valid(const struct plan *plan, const struct tables *tables) {
    if (plan->samples < 1 || plan->samples > MAX_SAMPLES) {
        PyErr_Format(PyExc_ValueError, "%lld samples to compose, not 1 to %d", (long long)plan->samples, (int)MAX_SAMPLES);
        return 0;
    }
    int64_t block = plan->block_samples;
    if (block < GROUP_SAMPLES || block > MAX_BLOCK_SAMPLES || block % GROUP_SAMPLES) {
        PyErr_Format(
            PyExc_ValueError, "blocks of %lld samples: not %d to %d, in eights", (long long)block, (int)GROUP_SAMPLES, (int)MAX_BLOCK_SAMPLES);
        return 0;
    }
    int64_t values = (plan->samples + (plan->samples + REST_SAMPLES - 1) / REST_SAMPLES) * CHANNELS;
    if (tables->there) values = tables->in_band.row_bytes;
    if (plan->idle_word >= 0 && plan->idle_word <= UINT32_MAX && plan->nx >= 1 && plan->nx <= INT32_MAX && plan->ny >= 1 &&
        plan->ny <= INT32_MAX && plan->entries >= 0 && plan->entries <= INT32_MAX && values <= plan->stride && plan->stride <= INT32_MAX &&
        (!tables->there || (plan->nx >= tables->in_band.across && plan->ny >= tables->in_band.across)) &&
        plan->pitch_m > 0 && plan->pitch_m < INFINITY && isfinite(plan->x0_m) && isfinite(plan->y0_m) && plan->equaliser >= 0 &&
        plan->equaliser <= LARGEST_EQUALISER && plan->band_lost >= 0 && plan->band_lost <= 1)
        return 1;
    PyErr_SetString(PyExc_ValueError, "a number of the plan is beyond its range");
    return 0;
}

/* Numbers of a point; 0 with an exception if they are not three, or beyond their range. */
static int read_point(PyObject *points, Py_ssize_t index, double *read) {
    PyObject *point = PySequence_GetItem(points, index);
    if (!point) return 0;
    Py_ssize_t size = PySequence_Size(point);
    int good = size == 3;
    if (!good && !PyErr_Occurred()) PyErr_SetString(PyExc_ValueError, "points to compose have x_m, y_m and amplitude");
    for (int i = 0; good && i < 3; i++) {
        PyObject *number = PySequence_GetItem(point, i);
        read[i] = number ? PyFloat_AsDouble(number) : -1;
        Py_XDECREF(number);
        good = !(read[i] == -1 && PyErr_Occurred());
    }
    Py_DECREF(point);
    if (!good) return 0;
    if (!isfinite(read[0]) || !isfinite(read[1]))
        PyErr_SetString(PyExc_ValueError, "a place of the points to compose is not finite");
    else if (!(read[2] > 0 && read[2] <= 1))
        PyErr_SetString(PyExc_ValueError, "an amplitude of the points to compose is not above 0 and at most 1");
    else {
        if (read[2] < LEAST_AMPLITUDE) read[2] = LEAST_AMPLITUDE;
        return 1;
    }
    return 0;
}

static Py_ssize_t room_needed(int64_t samples) {
    int64_t rows = (samples + REST_SAMPLES - 1) / REST_SAMPLES, of_sketches = (MAX_FOCI + 2) * (samples + GROUP_SAMPLES);
    int64_t of_nulls = 27 * (samples + rows + MAX_BLOCK_SAMPLES); /* MAX_NULLS times SUMS, PLACES of the last one, one to equalise */
    return 4 * CHANNELS * ((MAX_FOCI + 2) * (samples + rows) + 5 * (samples + MAX_BLOCK_SAMPLES) + of_sketches) + 2 * CHANNELS * of_nulls;
}

static void lay_out(struct work *work, const struct plan *plan, int count, uint8_t *room, void *words) {
    work->count = count;
    work->values = plan->samples * CHANNELS;
    work->rests = (plan->samples + REST_SAMPLES - 1) / REST_SAMPLES * CHANNELS;
    work->rows = (plan->samples + GROUP_SAMPLES - 1) / GROUP_SAMPLES;
    work->block_rows = plan->block_samples / GROUP_SAMPLES;
    work->blocks = (work->rows + work->block_rows - 1) / work->block_rows;
    work->idle_word = (uint32_t)plan->idle_word;
    work->step = plan->block_samples < STEPS_PER_BLOCK ? 1 : plan->block_samples / STEPS_PER_BLOCK;
    work->words = words;
    room += -(uintptr_t)room % LINE_BYTES;
    for (int i = 0; i < count; i++) {
        work->response[i] = (int16_t *)room;
        work->rest[i] = work->response[i] + work->rows * ROW;
        room += (work->rows * ROW + work->rows * ROW / REST_SAMPLES) * (int64_t)sizeof(int16_t);
    }
    work->sketch_step = plan->block_samples < SKETCHED_PER_BLOCK ? 1 : plan->block_samples / SKETCHED_PER_BLOCK;
    work->sketch_rows = (plan->samples + work->sketch_step * GROUP_SAMPLES - 1) / (work->sketch_step * GROUP_SAMPLES);
    for (int i = 0; i < count; i++, room += work->sketch_rows * ROW * (int64_t)sizeof(int16_t)) work->sketch[i] = (int16_t *)room;
    work->strength = (int32_t *)room;
    work->threshold = work->strength + work->blocks * CHANNELS;
    work->near_low = work->threshold + work->blocks * CHANNELS;
    work->near_high = work->near_low + work->blocks * CHANNELS;
    work->near = (uint32_t *)(work->near_high + work->blocks * CHANNELS);
    work->threshold_of_one = (int16_t *)(work->near + plan->samples);
}

enum { WORDS, ROOM, PLAN, ENTRIES, SCALES, GOOD, RESPONSE, TABLES, BUFFERS };
enum { BANK = PLAN, POINTS, NULLS }; /* arguments: words, room, the bank's buffers as a tuple, points, nulls */

/* Calls `use` with the buffers of the arguments, all of which it may read, and words and room it may write. */
static PyObject *with_buffers(const char *name, PyObject *const *arguments, Py_ssize_t given, int wanted,
                              PyObject *(*use)(const Py_buffer *, PyObject *const *)) {
    Py_buffer buffer[BUFFERS];
    PyObject *answer = NULL;
    int taken = 0;
    if (given != wanted) return PyErr_Format(PyExc_TypeError, "%s takes %d arguments, not %zd", name, wanted, given);
    if (!PyTuple_Check(arguments[BANK]) || PyTuple_Size(arguments[BANK]) != BUFFERS - BANK)
        return PyErr_Format(PyExc_TypeError, "a bank is a tuple of %d buffers", BUFFERS - BANK);
    for (; taken < BUFFERS; taken++) {
        PyObject *from = taken < BANK ? arguments[taken] : PyTuple_GetItem(arguments[BANK], taken - BANK);
        if (PyObject_GetBuffer(from, buffer + taken, taken <= ROOM ? PyBUF_WRITABLE : PyBUF_SIMPLE)) break;
    }
    if (taken == BUFFERS) answer = use(buffer, arguments);
    while (taken--) PyBuffer_Release(buffer + taken);
    return answer;
}

/* The bank in the buffers; 0 with an exception if they do not fit each other. */
static int take_bank(const Py_buffer *buffer, struct bank *bank) {
    struct plan *plan = &bank->plan;
    if (buffer[PLAN].len != sizeof *plan) {
        PyErr_Format(PyExc_ValueError, "a plan has %zd bytes, not %zd", (Py_ssize_t)sizeof *plan, buffer[PLAN].len);
        return 0;
    }
    memcpy(plan, buffer[PLAN].buf, sizeof *plan);
    bank->tables.there = 0;
    int possible = plan->samples >= 1 && plan->samples <= MAX_SAMPLES;
    if (possible && !take_tables(buffer + TABLES, plan->samples, &bank->tables)) return 0;
    if (!valid(plan, &bank->tables)) return 0;
    if (buffer[ENTRIES].len / 4 / plan->nx < plan->ny || buffer[SCALES].len / 4 < plan->entries || buffer[GOOD].len < plan->entries) {
        PyErr_SetString(PyExc_ValueError, "the tables are too short for the plan");
        return 0;
    }
    bank->entries = buffer[ENTRIES].buf;
    bank->scales = buffer[SCALES].buf;
    bank->good = buffer[GOOD].buf;
    bank->response = buffer[RESPONSE].buf;
    bank->response_bytes = buffer[RESPONSE].len;
    return 1;
}

/* Whether words and room are long enough; 0 with an exception. */
static int has_room(const Py_buffer *buffer, int64_t samples) {
    if (buffer[WORDS].len < 4 * samples)
        PyErr_Format(PyExc_ValueError, "%lld words do not fit into %zd bytes", (long long)samples, buffer[WORDS].len);
    else if (buffer[ROOM].len < room_needed(samples))
        PyErr_Format(PyExc_ValueError, "%lld samples need %zd bytes of room, not %zd", (long long)samples, room_needed(samples), buffer[ROOM].len);
    else
        return 1;
    return 0;
}

static PyObject *compose_with(const Py_buffer *buffer, PyObject *const *arguments, int8_t *polarity) {
    PyObject *points = arguments[POINTS];
    struct bank bank;
    struct work work;
    struct patch patches[MAX_FOCI];
    double point[MAX_FOCI][3], asked[MAX_FOCI], strongest = 0;
    if (!take_bank(buffer, &bank)) return NULL;
    const struct plan *plan = &bank.plan;
    Py_ssize_t count = PySequence_Size(points);
    if (count < 0) return NULL;
    if (count < 1 || count > MAX_FOCI)
        return PyErr_Format(PyExc_ValueError, "%zd points to compose, not 1 to %d", count, (int)MAX_FOCI);
    for (Py_ssize_t i = 0; i < count; i++) {
        if (!read_point(points, i, point[i])) return NULL;
        asked[i] = point[i][2];
        if (asked[i] > strongest) strongest = asked[i];
    }
    if (!has_room(buffer, plan->samples)) return NULL;
    for (Py_ssize_t i = 0; i < count; i++) {
        int wide = count > FEW_POINTS || asked[i] < strongest * FAINT;
        int64_t cell = find_patch(&bank, point[i][0], point[i][1], wide, patches + i);
        if (cell == -2) return NULL;
        if (cell >= 0) return PyLong_FromLongLong(cell);
    }
    lay_out(&work, plan, (int)count, buffer[ROOM].buf, buffer[WORDS].buf);
    compose_points(&work, patches, asked, polarity);
    return PyLong_FromLong(-1);
}

static PyObject *compose_in(const Py_buffer *buffer, PyObject *const *arguments) {
    int8_t polarity[MAX_FOCI] = {0};
    return compose_with(buffer, arguments, polarity);
}

static PyObject *compose_alike(const Py_buffer *buffer, PyObject *const *arguments) {
    Py_buffer polarity;
    PyObject *answer = NULL;
    if (PyObject_GetBuffer(arguments[NULLS], &polarity, PyBUF_WRITABLE)) return NULL;
    if (polarity.len == MAX_FOCI)
        answer = compose_with(buffer, arguments, polarity.buf);
    else
        PyErr_Format(PyExc_ValueError, "%zd polarities, not %d", polarity.len, (int)MAX_FOCI);
    PyBuffer_Release(&polarity);
    return answer;
}

static PyObject *compose(PyObject *module, PyObject *const *arguments, Py_ssize_t given) {
    (void)module;
    if (given == NULLS + 1) return with_buffers("compose", arguments, given, NULLS + 1, compose_alike);
    return with_buffers("compose", arguments, given, NULLS, compose_in);
}

/* ---- words: places that stay still, numbers of null_twin.py ---- */

enum {
    MAX_NULLS = 4,
    TIMES = 7, /* around T, a twelfth of a block apart, at which a pad is kept still */
    SWEEPS = 3,
    BLOCKS_APART = 2, /* of those from which the equations are taken */
    PLACES = 6, /* of a pad, in a ring */
    SUMS = 5, /* of what is met there */
    SUM_SHIFT = 3, /* bits that responses lose before */
    MARGIN_WEIGHT_SUM = 4095, /* of the points, and 15 times as much for the corrections: below 2^31 together */
    CORRECTION_WEIGHT_SUM = 61440,
    WEIGHT_BITS = 20,
};
static const double FLOOR = 0.25, RIDGE = 0.3, PI = 3.141592653589793;
static const double RING_M[PLACES][2] = {{2.8e-3, 0.0},   {1.4e-3, 2.42487113e-3},   {-1.4e-3, 2.42487113e-3},
                                         {-2.8e-3, 0.0}, {-1.4e-3, -2.42487113e-3}, {1.4e-3, -2.42487113e-3}};

static const int SUMS_OF[MAX_NULLS] = {SUMS, 1, 1, 1}; /* of each of so many pads */

/* A sum of a pad that shall stay still: as a response between zeros, as it is met at other times; the factors of its equations. */
struct still {
    int16_t *response;
    double lower[TIMES][TIMES], pivot[TIMES];
    int solvable;
};

struct nulls {
    int64_t values, rows, block_rows, blocks, step; /* rows of eight samples */
    int32_t *sum, *strength;
    int64_t *weight;
    int16_t *above; /* where bits deviate: -1, else 0 */
    struct still sums[SUMS * MAX_NULLS];
    double unit;
    int64_t spent;
};

APART void add_shifted(int32_t *restrict sum, const int16_t *restrict a, const int16_t *restrict b, int samples) {
    for (int sample = 0; sample < samples; sample++)
        for (int i = 0; i < CHANNELS; i++)
            sum[i] += (a[CHANNELS * sample + i] >> SKETCH_SHIFT) * (b[CHANNELS * sample + i] >> SKETCH_SHIFT);
}

/* Bits that deviate from idle, in the order of values. */
static void take_bits(struct nulls *nulls, const uint32_t *words, uint32_t idle_word) {
    int channel[CHANNELS];
    for (int i = 0; i < CHANNELS; i++) channel[i] = i / 16 * 16 + i % 8 * 2 + i / 8 % 2;
    memset(nulls->above, 0, (size_t)(nulls->rows * ROW) * sizeof *nulls->above);
    for (int64_t sample = 0; sample < nulls->values / CHANNELS; sample++) {
        uint32_t deviates = words[sample] ^ idle_word;
        for (int i = 0; i < CHANNELS; i++) nulls->above[sample * CHANNELS + i] = (int16_t) - (int16_t)(deviates >> channel[i] & 1);
    }
}

/* From the weighted sum of the points' responses: how much each bit may be weighed against, above zero where it deviates. */
APART void set_margins(int32_t *restrict sum, const int16_t *restrict above) {
    for (int i = 0; i < ROW; i++) {
        int32_t size = sum[i] < 0 ? -sum[i] : sum[i];
        sum[i] = above[i] ? size + 1 : -size;
    }
}

/* Inner products of the response with itself at other times, and what solves the equations of corrections. */
static void prepare_still(struct nulls *nulls, struct still *still) {
    double products[TIMES];
    for (int lag = 0; lag < TIMES; lag++) {
        int64_t total = 0;
        for (int64_t block = 0; block < nulls->blocks; block += BLOCKS_APART) {
            int32_t sum[CHANNELS] = {0};
            int64_t at = block * nulls->block_rows * ROW, left = (nulls->values - at) / CHANNELS, most = nulls->block_rows * GROUP_SAMPLES;
            add_shifted(sum, still->response + at, still->response + at - lag * nulls->step * CHANNELS, (int)(left < most ? left : most));
            for (int i = 0; i < CHANNELS; i++) total += sum[i] * nulls->weight[block * CHANNELS + i];
        }
        products[lag] = (double)total * ((double)nulls->blocks / (double)((nulls->blocks + BLOCKS_APART - 1) / BLOCKS_APART));
    }
    still->solvable = products[0] > 0;
    for (int i = 0; still->solvable && i < TIMES; i++)
        for (int j = 0; j <= i; j++) {
            double value = i == j ? products[0] * (1 + RIDGE) : products[i - j];
            for (int k = 0; k < j; k++) value -= still->lower[i][k] * still->lower[j][k] * still->pivot[k];
            if (j < i) {
                still->lower[i][j] = value / still->pivot[j];
                continue;
            }
            still->pivot[i] = value;
            if (!(value > 0)) still->solvable = 0;
        }
}

/* Inner products of bits, -1 or 0, with a response at all times; `last` is how it is met latest. */
APART void products_of_times(const int16_t *restrict above, const int16_t *restrict last, int64_t step, int64_t values, int64_t *restrict product) {
    uints sum[TIMES] = {{0}};
    for (int64_t i = 0; i < values; i += LANES)
        for (int j = 0; j < TIMES; j++) sum[j] = add_products(sum[j], load(above + i), load(last + j * step + i));
    for (int j = 0; j < TIMES; j++) product[TIMES - 1 - j] = sum_of(sum[j]);
}

/* Add a response at all times, each with its weight, to the sums of eight samples. */
APART void add_times(int32_t *restrict sum, const int16_t *restrict last, int64_t step, const int16_t *restrict weight) {
    int16_t from_last[TIMES];
    ushorts pair[TIMES / 2 + 1];
    for (int j = 0; j < TIMES; j++) from_last[j] = weight[TIMES - 1 - j];
    pair_weights(TIMES, from_last, pair);
    for (int i = 0; i < ROW; i += LANES) {
        uints low, high;
        load_sums(sum + i, &low, &high);
        for (int j = 0; j < TIMES; j += 2) {
            const int16_t *one = last + j * step + i;
            add_pair(&low, &high, load(one), load(j + 1 < TIMES ? one + step : one), pair[j / 2]);
        }
        store_sums(sum + i, low, high);
    }
}

/* Weigh the bits against what they give to a sum, and set them again. */
static void correct(struct nulls *nulls, const struct still *still) {
    double value[TIMES];
    int16_t weight[TIMES];
    int64_t weights = 0, product[TIMES], step = nulls->step * CHANNELS;
    const int16_t *last = still->response - TIMES / 2 * step;
    products_of_times(nulls->above, last, step, nulls->values, product);
    for (int j = 0; j < TIMES; j++) value[j] = -(double)product[j];
    for (int i = 0; i < TIMES; i++)
        for (int k = 0; k < i; k++) value[i] -= still->lower[i][k] * value[k];
    for (int i = 0; i < TIMES; i++) value[i] /= still->pivot[i];
    for (int i = TIMES - 1; i >= 0; i--)
        for (int k = i + 1; k < TIMES; k++) value[i] -= still->lower[k][i] * value[k];
    for (int j = 0; j < TIMES; j++) {
        double scaled = value[j] * nulls->unit;
        if (!(fabs(scaled) < INT16_MAX)) return;
        weight[j] = (int16_t)-nearest(scaled);
        weights += weight[j] < 0 ? -weight[j] : weight[j];
    }
    if (nulls->spent + weights > CORRECTION_WEIGHT_SUM) return;
    nulls->spent += weights;
    for (int64_t at = 0; at < nulls->rows * ROW; at += ROW) {
        add_times(nulls->sum + at, last + at, step, weight);
        compare_nothing(nulls->above + at, nulls->sum + at);
    }
    memset(nulls->above + nulls->values, 0, (size_t)(nulls->rows * ROW - nulls->values) * sizeof *nulls->above);
}

/* Five sums of what is met at six places of a ring, in the order of `SUMS` of null_twin.py; the places lie `apart`. */
APART void sums_of_ring(const int16_t *restrict met, int64_t apart, int16_t *const *sum, int64_t values) {
    int16_t *restrict a = sum[0], *restrict b = sum[1], *restrict c = sum[2], *restrict d = sum[3], *restrict e = sum[4];
    for (int64_t i = 0; i < values; i++) {
        int16_t near[PLACES];
        for (int place = 0; place < PLACES; place++) near[place] = met[place * apart + i];
        int16_t first = (int16_t)(near[0] + near[3]), second = (int16_t)(near[1] + near[4]), third = (int16_t)(near[2] + near[5]);
        int16_t to_first = (int16_t)(near[0] - near[3]), to_second = (int16_t)(near[1] - near[4]), to_third = (int16_t)(near[2] - near[5]);
        a[i] = (int16_t)(first + second + third);
        b[i] = (int16_t)(2 * to_first + to_second - to_third);
        c[i] = (int16_t)(to_second + to_third);
        d[i] = (int16_t)(2 * first - second - third);
        e[i] = (int16_t)(second - third);
    }
}

INLINE ushorts add_saturated(ushorts a, ushorts b) {
#ifdef __SSE2__
    return (ushorts)X86(adds_epi16)((machine)a, (machine)b);
#elif defined __ARM_NEON
    return (ushorts)vqaddq_s16((int16x8_t)a, (int16x8_t)b);
#else
    shorts sum;
    for (int lane = 0; lane < 8; lane++) {
        int32_t both = (int16_t)a[lane] + (int16_t)b[lane];
        sum[lane] = (int16_t)(both > INT16_MAX ? INT16_MAX : both < INT16_MIN ? INT16_MIN : both);
    }
    return (ushorts)sum;
#endif
}

enum { LARGEST_SUMMED = (1 << (15 - SUM_SHIFT)) - 1 };

/* A response and what is outside the band, together within 16 bits, less some bits, in its place; of a compact bank, whose responses
   are too faint to lose bits, at most as large as if they had. */
APART void add_rests(int faint, int16_t *response, const int16_t *rest, int64_t values) {
    enum { BOTH = REST_SAMPLES * CHANNELS };
    ushorts above = (ushorts){0} + (INT16_MAX - LARGEST_SUMMED), below = (ushorts){0} + (uint16_t)(INT16_MIN + LARGEST_SUMMED);
    for (int64_t at = 0; at < values; at += BOTH, rest += CHANNELS)
        for (int i = 0; i < CHANNELS; i += LANES)
            for (int64_t to = at + i; to < at + BOTH; to += CHANNELS) {
                ushorts both = add_saturated(load(response + to), load(rest + i));
                if (faint)
                    both = add_saturated(add_saturated(both, above) - above, below) - below;
                else
                    both = (ushorts)((shorts)both >> SUM_SHIFT);
                store(response + to, both);
            }
}

/* The sums of a pad from the patches of its places; `room` begins with the sums and ends with what is met. Returns where it goes on. */
static int16_t *take_sums(struct nulls *nulls, struct still *still, const struct work *work, const struct patch *patches, int16_t *room) {
    int64_t padded = nulls->rows * ROW, reach = TIMES * nulls->step * CHANNELS, whole = padded + 2 * reach;
    int16_t *sums[SUMS], *met = room + SUMS * whole, *beyond = met + PLACES * padded;
    memset(room, 0, (size_t)(SUMS * whole) * sizeof *room);
    for (int i = 0; i < SUMS; i++) still[i].response = sums[i] = room + i * whole + reach;
    for (int place = 0; place < PLACES; place++) {
        int16_t *here = met + place * padded;
        respond(work, patches + place, here, beyond);
        respond_outside(work, patches + place, here, beyond);
        add_rests(patches->tables != NULL, here, beyond, work->values);
    }
    sums_of_ring(met, padded, sums, nulls->values);
    for (int i = 0; i < SUMS; i++) prepare_still(nulls, still + i);
    return met;
}

static void keep_still(struct work *work, const struct patch *patches, const struct patch *places, int count, int64_t step) {
    struct nulls nulls = {.values = work->values, .rows = work->rows, .block_rows = work->block_rows, .blocks = work->blocks, .step = step};
    int64_t padded = nulls.rows * ROW, total = 0;
    int16_t weight[MAX_FOCI];
    double share[MAX_FOCI], shares = 0;
    uint8_t *room = (uint8_t *)work->strength; /* behind the responses */
    nulls.weight = (int64_t *)room;
    nulls.sum = (int32_t *)(nulls.weight + nulls.blocks * CHANNELS);
    nulls.strength = nulls.sum + padded;
    nulls.above = (int16_t *)(nulls.strength + nulls.blocks * CHANNELS);
    int16_t *next = nulls.above + padded;
    take_bits(&nulls, work->words, work->idle_word);
    for (int i = 0; i < work->count; i++) {
        int64_t norm = respond(work, patches + i, work->response[i], next);
        memset(work->response[i] + work->values, 0, (size_t)(padded - work->values) * sizeof(int16_t));
        int64_t given = -(int64_t)inner_product(nulls.above, work->response[i], (int)work->values);
        share[i] = norm ? 1 / (double)norm : 0;
        shares += share[i];
        if (given < 0) share[i] = -share[i];
    }
    if (shares == 0) return;
    double share_unit = MARGIN_WEIGHT_SUM / shares;
    for (int i = 0; i < work->count; i++) weight[i] = (int16_t)nearest(share[i] * share_unit);
    memset(nulls.strength, 0, (size_t)(nulls.blocks * CHANNELS) * sizeof *nulls.strength);
    for (int64_t row = 0; row < nulls.rows; row++) {
        add_up(work->count, work->response, weight, row * ROW, nulls.sum + row * ROW);
        add_strength(nulls.strength + row / nulls.block_rows * CHANNELS, nulls.sum + row * ROW, GROUP_SAMPLES);
        set_margins(nulls.sum + row * ROW, nulls.above + row * ROW);
    }
    for (int64_t i = 0; i < nulls.blocks * CHANNELS; i++) total += nulls.strength[i];
    if (total == 0) return;
    double floor = (double)total * FLOOR / (double)(nulls.blocks * CHANNELS), scale = floor * (1 << WEIGHT_BITS);
    for (int64_t i = 0; i < nulls.blocks * CHANNELS; i++) {
        double strength = (double)nulls.strength[i];
        nulls.weight[i] = (int64_t)nearest(scale / (strength > floor ? strength : floor));
    }
    nulls.unit = PI * scale / (double)(nulls.block_rows * GROUP_SAMPLES);
    for (int i = 0; i < count; i++) next = take_sums(&nulls, nulls.sums + SUMS * i, work, places + PLACES * i, next);
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int i = 0; i < SUMS * count; i++)
            if (i % SUMS < SUMS_OF[count - 1] && nulls.sums[i].solvable) correct(&nulls, nulls.sums + i);
    for (int64_t row = 0; row < nulls.rows; row++) {
        int64_t left = (nulls.values - row * ROW) / CHANNELS;
        write_words(work, row * ROW, left < GROUP_SAMPLES ? (int)left : GROUP_SAMPLES, nulls.above + row * ROW);
    }
}

static PyObject *null_places_in(const Py_buffer *buffer, PyObject *const *arguments) {
    PyObject *points = arguments[POINTS], *places = arguments[NULLS];
    struct bank bank;
    struct work work;
    struct patch patches[MAX_FOCI + PLACES * MAX_NULLS];
    double point[MAX_FOCI + MAX_NULLS][3];
    if (!take_bank(buffer, &bank)) return NULL;
    const struct plan *plan = &bank.plan;
    Py_ssize_t count = PySequence_Size(points), still = PySequence_Size(places);
    if (count < 0 || still < 0) return NULL;
    if (count < 1 || count > MAX_FOCI || still < 1 || still > MAX_NULLS)
        return PyErr_Format(PyExc_ValueError, "%zd points, not 1 to %d, and %zd nulls, not 1 to %d", count, (int)MAX_FOCI, still,
                            (int)MAX_NULLS);
    for (Py_ssize_t i = 0; i < count + still; i++)
        if (!read_point(i < count ? points : places, i < count ? i : i - count, point[i])) return NULL;
    if (!has_room(buffer, plan->samples)) return NULL;
    for (Py_ssize_t i = 0; i < count + PLACES * still; i++) {
        static const double MIDDLE[2] = {0, 0};
        const double *of = point[i < count ? i : count + (i - count) / PLACES], *beside = i < count ? MIDDLE : RING_M[(i - count) % PLACES];
        int64_t cell = find_patch(&bank, of[0] + beside[0], of[1] + beside[1], 0, patches + i);
        if (cell == -2) return NULL;
        if (cell >= 0) return PyLong_FromLongLong(cell);
    }
    lay_out(&work, plan, (int)count, buffer[ROOM].buf, buffer[WORDS].buf);
    keep_still(&work, patches, patches + count, (int)still, work.step);
    return PyLong_FromLong(-1);
}

static PyObject *null_places(PyObject *module, PyObject *const *arguments, Py_ssize_t given) {
    (void)module;
    return with_buffers("null_places", arguments, given, NULLS + 1, null_places_in);
}

/* ---- frames ---- */

enum {
    // generated: frames
    FRAME_SYNC = 0xA55A,
    LOAD = 3, /* type of frame */
    CHUNK_BYTES = 500, /* words of a LOAD frame that is not the last */
    PADDED_BYTES = 20, /* shortest payload of a LOAD */
    CHUNKS = 8,
    SHORT_FRAME_BYTES = 36, /* of a status, too */
    NUMBER_AT = 3, /* byte of the header */
    FAULTS_AT = 6, /* byte of a status */
    CRC_OF_INTACT = 0x2144DF1C, /* of any message with its own CRC behind it */
    HEADER_BYTES = 8,
    TYPE_AT = 2, /* byte of the header */
    LENGTH_AT = 4,
    ARGUMENT_AT = 6,
    CRC_BYTES = 4,
    // end of frames
    FULL_FRAME_BYTES = HEADER_BYTES + CHUNK_BYTES + CRC_BYTES,
    ABREAST = 4, /* frames whose CRCs are computed together: one waits for each of its lookups */
};

static uint32_t crc_table[8][256]; /* [n]: a byte, then n zero bytes */
static uint32_t chunk_table[4][256]; /* [n]: byte n of a state, then as many zero bytes as a chunk has */
static uint32_t number_change[256]; /* of a full frame's CRC, by number ^ number */

static int machine_has_crc; /* an instruction for what is a table's work elsewhere */

/* States are CRCs without the inversions before and after: linear in the bytes. */
INLINE uint32_t crc_eight(uint32_t state, uint64_t bytes) {
#ifdef __aarch64__
    if (machine_has_crc) {
        __asm__(".arch_extension crc\n\tcrc32x %w0, %w0, %x1" : "+r"(state) : "r"(bytes));
        return state;
    }
#endif
    bytes ^= state;
    return crc_table[7][bytes & 255] ^ crc_table[6][bytes >> 8 & 255] ^ crc_table[5][bytes >> 16 & 255] ^ crc_table[4][bytes >> 24 & 255] ^
           crc_table[3][bytes >> 32 & 255] ^ crc_table[2][bytes >> 40 & 255] ^ crc_table[1][bytes >> 48 & 255] ^ crc_table[0][bytes >> 56];
}

INLINE uint64_t get_eight(const uint8_t *from) {
    uint64_t bytes;
    memcpy(&bytes, from, sizeof bytes);
    return bytes;
}

INLINE uint32_t get_u32(const uint8_t *from) {
    uint32_t value;
    memcpy(&value, from, sizeof value);
    return value;
}

INLINE void put_u32(uint8_t *to, uint32_t value) { memcpy(to, &value, sizeof value); }

static uint32_t crc_state(uint32_t state, const uint8_t *bytes, Py_ssize_t length) {
    for (; length >= 8; length -= 8, bytes += 8) state = crc_eight(state, get_eight(bytes));
    for (; length > 0; length--, bytes++) state = state >> 8 ^ crc_table[0][(uint8_t)(state ^ *bytes)];
    return state;
}

static uint32_t crc32(const uint8_t *bytes, Py_ssize_t length) { return ~crc_state(~0u, bytes, length); }

static uint32_t crc_of_zeros(uint32_t state, Py_ssize_t length) {
    for (; length >= 8; length -= 8) state = crc_eight(state, 0);
    for (; length > 0; length--) state = state >> 8 ^ crc_table[0][(uint8_t)state];
    return state;
}

INLINE uint32_t after_chunk(uint32_t state) {
    return chunk_table[0][state & 255] ^ chunk_table[1][state >> 8 & 255] ^ chunk_table[2][state >> 16 & 255] ^ chunk_table[3][state >> 24];
}

static uint32_t change_of(uint8_t numbers, Py_ssize_t frame_bytes) {
    return crc_of_zeros(crc_table[0][numbers], frame_bytes - CRC_BYTES - NUMBER_AT - 1);
}

static void fill_tables(void) {
    machine_has_crc = MACHINE_HAS_CRC;
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t state = byte;
        for (int bit = 0; bit < 8; bit++) state = state >> 1 ^ (0xEDB88320u & -(state & 1));
        crc_table[0][byte] = state;
    }
    for (int n = 1; n < 8; n++)
        for (int byte = 0; byte < 256; byte++)
            crc_table[n][byte] = crc_table[n - 1][byte] >> 8 ^ crc_table[0][(uint8_t)crc_table[n - 1][byte]];
    for (int n = 0; n < 4; n++)
        for (uint32_t byte = 0; byte < 256; byte++) chunk_table[n][byte] = crc_of_zeros(byte << 8 * n, CHUNK_BYTES);
    for (int numbers = 0; numbers < 256; numbers++) number_change[numbers] = change_of((uint8_t)numbers, FULL_FRAME_BYTES);
}

/* Full frames, and bytes of the shorter one behind them: with header, payload and CRC. */
struct loads {
    Py_ssize_t full, rest;
};

static Py_ssize_t frames_bytes(struct loads loads) { return loads.full * FULL_FRAME_BYTES + loads.rest; }

static int loads_of_words(Py_ssize_t words_bytes, struct loads *loads) {
    if (words_bytes < 4 || words_bytes > CHUNKS * CHUNK_BYTES || words_bytes % 4) {
        PyErr_Format(PyExc_ValueError, "a waveform has 4 to %d bytes, a multiple of 4, not %zd", (int)(CHUNKS * CHUNK_BYTES), words_bytes);
        return 0;
    }
    Py_ssize_t rest = words_bytes % CHUNK_BYTES;
    loads->full = words_bytes / CHUNK_BYTES;
    loads->rest = rest ? HEADER_BYTES + (rest < PADDED_BYTES ? PADDED_BYTES : rest) + CRC_BYTES : 0;
    return 1;
}

static int loads_of_frames(Py_ssize_t total, struct loads *loads) {
    Py_ssize_t full = total / FULL_FRAME_BYTES, rest = total % FULL_FRAME_BYTES;
    if (!total || full + !!rest > CHUNKS || (rest && (rest < HEADER_BYTES + PADDED_BYTES + CRC_BYTES || rest % 4))) {
        PyErr_Format(PyExc_ValueError, "%zd bytes are not the LOAD frames of a waveform", total);
        return 0;
    }
    *loads = (struct loads){full, rest};
    return 1;
}

static int fits(const Py_buffer *out, Py_ssize_t total) {
    if (out->len >= total) return 1;
    PyErr_Format(PyExc_ValueError, "%zd bytes of frames do not fit into %zd", total, out->len);
    return 0;
}

INLINE uint64_t load_header(uint8_t number, Py_ssize_t frame_bytes, Py_ssize_t chunk) {
    uint64_t payload_bytes = (uint64_t)(frame_bytes - HEADER_BYTES - CRC_BYTES);
    return FRAME_SYNC | LOAD << 8 * TYPE_AT | (uint64_t)number << 8 * NUMBER_AT | payload_bytes << 8 * LENGTH_AT |
           (uint64_t)chunk << 8 * ARGUMENT_AT;
}

INLINE void put_header(uint8_t *frame, uint64_t header) { memcpy(frame, &header, sizeof header); }

/* States of full frames that lie back to back. */
static void crc_of_full_frames(const uint8_t *frames, Py_ssize_t count, uint32_t *state) {
    enum { COVERED = FULL_FRAME_BYTES - CRC_BYTES, EIGHTS = COVERED / 8 * 8 };
    for (; count >= ABREAST; count -= ABREAST, frames += ABREAST * FULL_FRAME_BYTES, state += ABREAST) {
        uint32_t a = ~0u, b = ~0u, c = ~0u, d = ~0u;
        const uint8_t *bytes = frames;
        for (int at = 0; at < EIGHTS; at += 8, bytes += 8) {
            a = crc_eight(a, get_eight(bytes));
            b = crc_eight(b, get_eight(bytes + FULL_FRAME_BYTES));
            c = crc_eight(c, get_eight(bytes + 2 * FULL_FRAME_BYTES));
            d = crc_eight(d, get_eight(bytes + 3 * FULL_FRAME_BYTES));
        }
        state[0] = crc_state(a, bytes, COVERED - EIGHTS);
        state[1] = crc_state(b, bytes + FULL_FRAME_BYTES, COVERED - EIGHTS);
        state[2] = crc_state(c, bytes + 2 * FULL_FRAME_BYTES, COVERED - EIGHTS);
        state[3] = crc_state(d, bytes + 3 * FULL_FRAME_BYTES, COVERED - EIGHTS);
    }
    for (; count; count--, frames += FULL_FRAME_BYTES, state++) *state = crc_state(~0u, frames, COVERED);
}

/* State of all words, from those of the full frames that have them: what the header and the words before leave behind is added at
   the end of a frame's words. */
static uint32_t crc_of_words(const uint8_t *frame, Py_ssize_t count, const uint32_t *state) {
    uint32_t all = ~0u;
    for (; count; count--, frame += FULL_FRAME_BYTES, state++) all = *state ^ after_chunk(all ^ crc_eight(~0u, get_eight(frame)));
    return all;
}

/* Pack words of a length that was checked; returns their CRC. */
static uint32_t pack_chunks(uint8_t *out, uint8_t sequence, const uint8_t *words, Py_ssize_t words_bytes, struct loads loads) {
    uint32_t state[CHUNKS], all;
    Py_ssize_t chunk;
    uint8_t *frame = out;
    for (chunk = 0; chunk < loads.full; chunk++, frame += FULL_FRAME_BYTES) {
        put_header(frame, load_header((uint8_t)(sequence + chunk), FULL_FRAME_BYTES, chunk));
        memcpy(frame + HEADER_BYTES, words + chunk * CHUNK_BYTES, CHUNK_BYTES);
    }
    crc_of_full_frames(out, loads.full, state);
    all = crc_of_words(out, loads.full, state);
    for (chunk = 0, frame = out; chunk < loads.full; chunk++, frame += FULL_FRAME_BYTES)
        put_u32(frame + FULL_FRAME_BYTES - CRC_BYTES, ~state[chunk]);
    if (loads.rest) {
        Py_ssize_t rest = words_bytes - loads.full * CHUNK_BYTES, covered = loads.rest - CRC_BYTES;
        put_header(frame, load_header((uint8_t)(sequence + chunk), loads.rest, chunk));
        memcpy(frame + HEADER_BYTES, words + loads.full * CHUNK_BYTES, (size_t)rest);
        memset(frame + HEADER_BYTES + rest, 0, (size_t)(covered - HEADER_BYTES - rest));
        put_u32(frame + covered, crc32(frame, covered));
        all = crc_state(all, frame + HEADER_BYTES, rest);
    }
    return ~all;
}

static void renumber(uint8_t *out, uint8_t sequence, const uint8_t *ready, struct loads loads) {
    memcpy(out, ready, (size_t)frames_bytes(loads));
    for (Py_ssize_t chunk = 0; chunk < loads.full + !!loads.rest; chunk++, out += FULL_FRAME_BYTES) {
        Py_ssize_t size = chunk < loads.full ? FULL_FRAME_BYTES : loads.rest;
        uint8_t number = (uint8_t)(sequence + chunk), numbers = (uint8_t)(number ^ chunk);
        uint8_t *crc = out + size - CRC_BYTES;
        put_header(out, load_header(number, size, chunk));
        put_u32(crc, get_u32(crc) ^ (size == FULL_FRAME_BYTES ? number_change[numbers] : change_of(numbers, size)));
    }
}

/* Take the words out of frames; the chunk of one that is damaged, or -1. */
static Py_ssize_t unpack_chunks(uint8_t *words, Py_ssize_t words_bytes, const uint8_t *frames, struct loads loads, uint32_t *crc) {
    uint32_t state[CHUNKS], all;
    const uint8_t *frame = frames;
    crc_of_full_frames(frames, loads.full, state);
    all = crc_of_words(frames, loads.full, state);
    for (Py_ssize_t chunk = 0; chunk < loads.full + !!loads.rest; chunk++, frame += FULL_FRAME_BYTES) {
        int full = chunk < loads.full;
        Py_ssize_t frame_bytes = full ? FULL_FRAME_BYTES : loads.rest, covered = frame_bytes - CRC_BYTES;
        Py_ssize_t size = full ? CHUNK_BYTES : words_bytes - chunk * CHUNK_BYTES;
        uint32_t found = full ? ~state[chunk] : crc32(frame, covered);
        if (get_eight(frame) != load_header((uint8_t)chunk, frame_bytes, chunk) || get_u32(frame + covered) != found) return chunk;
        for (Py_ssize_t at = HEADER_BYTES + size; at < covered; at++)
            if (frame[at]) return chunk;
        memcpy(words + chunk * CHUNK_BYTES, frame + HEADER_BYTES, (size_t)size);
        if (!full) all = crc_state(all, frame + HEADER_BYTES, size);
    }
    *crc = ~all;
    return -1;
}

/* ---- frames: from Python ---- */

/* Buffers to write and to read, or an exception. */
static int take_two(PyObject *written, PyObject *read, Py_buffer *to, Py_buffer *from) {
    if (PyObject_GetBuffer(written, to, PyBUF_WRITABLE)) return 0;
    if (!PyObject_GetBuffer(read, from, PyBUF_SIMPLE)) return 1;
    PyBuffer_Release(to);
    return 0;
}

static PyObject *pack_loads(PyObject *module, PyObject *const *arguments, Py_ssize_t given) {
    Py_buffer out, words;
    struct loads loads;
    PyObject *answer = NULL;
    (void)module;
    if (given != 3) return PyErr_Format(PyExc_TypeError, "pack_loads takes 3 arguments, not %zd", given);
    unsigned long sequence = PyLong_AsUnsignedLongMask(arguments[1]);
    if (sequence == (unsigned long)-1 && PyErr_Occurred()) return NULL;
    if (!take_two(arguments[0], arguments[2], &out, &words)) return NULL;
    if (loads_of_words(words.len, &loads) && fits(&out, frames_bytes(loads)))
        answer = PyLong_FromUnsignedLong(pack_chunks(out.buf, (uint8_t)sequence, words.buf, words.len, loads));
    PyBuffer_Release(&out);
    PyBuffer_Release(&words);
    return answer;
}

static PyObject *renumber_loads(PyObject *module, PyObject *const *arguments, Py_ssize_t given) {
    Py_buffer out, ready;
    struct loads loads;
    (void)module;
    if (given != 3) return PyErr_Format(PyExc_TypeError, "renumber_loads takes 3 arguments, not %zd", given);
    unsigned long sequence = PyLong_AsUnsignedLongMask(arguments[1]);
    if (sequence == (unsigned long)-1 && PyErr_Occurred()) return NULL;
    if (!take_two(arguments[0], arguments[2], &out, &ready)) return NULL;
    int good = loads_of_frames(ready.len, &loads) && fits(&out, ready.len);
    if (good) renumber(out.buf, (uint8_t)sequence, ready.buf, loads);
    PyBuffer_Release(&out);
    PyBuffer_Release(&ready);
    if (!good) return NULL;
    Py_RETURN_NONE;
}

static PyObject *unpack_loads(PyObject *module, PyObject *const *arguments, Py_ssize_t given) {
    Py_buffer words, ready;
    struct loads loads;
    PyObject *answer = NULL;
    (void)module;
    if (given != 2) return PyErr_Format(PyExc_TypeError, "unpack_loads takes 2 arguments, not %zd", given);
    if (!take_two(arguments[0], arguments[1], &words, &ready)) return NULL;
    if (loads_of_words(words.len, &loads)) {
        if (ready.len != frames_bytes(loads)) {
            PyErr_Format(PyExc_ValueError, "%zd bytes are not the frames of %zd bytes of words", ready.len, words.len);
        } else {
            uint32_t crc;
            Py_ssize_t damaged = unpack_chunks(words.buf, words.len, ready.buf, loads, &crc);
            if (damaged >= 0)
                PyErr_Format(PyExc_ValueError, "frame %zd is damaged", damaged);
            else
                answer = PyLong_FromUnsignedLong(crc);
        }
    }
    PyBuffer_Release(&words);
    PyBuffer_Release(&ready);
    return answer;
}

static PyObject *seal_short_frames(PyObject *module, PyObject *const *arguments, Py_ssize_t given) {
    (void)module;
    if (given != 4) return PyErr_Format(PyExc_TypeError, "seal_short_frames takes 4 arguments, not %zd", given);
    Py_ssize_t start = PyLong_AsSsize_t(arguments[1]);
    if (start == -1 && PyErr_Occurred()) return NULL;
    Py_ssize_t count = PyLong_AsSsize_t(arguments[2]);
    if (count == -1 && PyErr_Occurred()) return NULL;
    unsigned long sequence = PyLong_AsUnsignedLongMask(arguments[3]);
    if (sequence == (unsigned long)-1 && PyErr_Occurred()) return NULL;
    Py_buffer out;
    if (PyObject_GetBuffer(arguments[0], &out, PyBUF_WRITABLE)) return NULL;
    if (start < 0 || count < 0 || start > out.len || count > (out.len - start) / SHORT_FRAME_BYTES) {
        PyErr_Format(PyExc_ValueError, "%zd frames from byte %zd on do not fit into %zd bytes", count, start, out.len);
        PyBuffer_Release(&out);
        return NULL;
    }
    uint8_t *frame = (uint8_t *)out.buf + start;
    for (Py_ssize_t number = 0; number < count; number++, frame += SHORT_FRAME_BYTES) {
        frame[NUMBER_AT] = (uint8_t)(sequence + (unsigned long)number);
        put_u32(frame + SHORT_FRAME_BYTES - CRC_BYTES, crc32(frame, SHORT_FRAME_BYTES - CRC_BYTES));
    }
    PyBuffer_Release(&out);
    Py_RETURN_NONE;
}

static PyObject *statuses_good(PyObject *module, PyObject *const *args, Py_ssize_t given) {
    (void)module;
    if (given != 5) return PyErr_Format(PyExc_TypeError, "statuses_good takes 5 arguments, not %zd", given);
    Py_ssize_t start = PyLong_AsSsize_t(args[1]);
    Py_ssize_t count = PyLong_AsSsize_t(args[2]);
    unsigned long head = PyLong_AsUnsignedLongMask(args[3]);
    unsigned long sequence = PyLong_AsUnsignedLongMask(args[4]);
    if (PyErr_Occurred()) return NULL;
    Py_buffer answers;
    if (PyObject_GetBuffer(args[0], &answers, PyBUF_SIMPLE)) return NULL;
    if (start < 0 || count < 0 || start > answers.len || count > (answers.len - start) / SHORT_FRAME_BYTES) {
        PyErr_Format(PyExc_ValueError, "%zd statuses from byte %zd on are not within %zd bytes", count, start, answers.len);
        PyBuffer_Release(&answers);
        return NULL;
    }
    const uint8_t *status = (const uint8_t *)answers.buf + start;
    int good = 1;
    for (Py_ssize_t number = 0; good && number < count; number++, status += SHORT_FRAME_BYTES) {
        uint32_t first = status[0] | status[1] << 8 | status[2] << 16 | (uint32_t)status[3] << 24;
        good = first == ((uint32_t)head | (uint32_t)(uint8_t)(sequence + number) << 24) && !(status[FAULTS_AT] | status[FAULTS_AT + 1]) &&
               crc32(status, SHORT_FRAME_BYTES) == CRC_OF_INTACT;
    }
    PyBuffer_Release(&answers);
    return PyBool_FromLong(good);
}

/* Pointers to the strings of a tuple of bytes, and a NULL; to be freed by PyMem_Free. */
static char **strings(PyObject *tuple) {
    Py_ssize_t count = PyTuple_Size(tuple);
    if (count < 0) return NULL;
    char **all = PyMem_Calloc((size_t)count + 1, sizeof *all);
    if (!all) return (char **)PyErr_NoMemory();
    for (Py_ssize_t at = 0; at < count; at++)
        if (!(all[at] = PyBytes_AsString(PyTuple_GetItem(tuple, at)))) {
            PyMem_Free(all);
            return NULL;
        }
    return all;
}

static PyObject *start_program(PyObject *module, PyObject *const *arguments, Py_ssize_t given) {
    (void)module;
    if (given != 3) return PyErr_Format(PyExc_TypeError, "start_program takes 3 arguments, not %zd", given);
    int input = (int)PyLong_AsLong(arguments[2]);
    if (input == -1 && PyErr_Occurred()) return NULL;
    char **command = strings(arguments[0]);
    char **environment = command ? strings(arguments[1]) : NULL;
    PyObject *answer = NULL;
    if (environment) {
#ifdef __linux__
        /* In the new process there are no other threads, whose locks it might wait for: until the program begins it makes system calls
           alone. Not by fork(): handlers of libraries would run before it; those of OpenBLAS end its threads. */
        long process = syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
        if (process == 0) {
            int nothing = open("/dev/null", O_WRONLY);
            if (dup2(input, 0) == 0 && dup2(nothing, 1) == 1) execve(command[0], command, environment);
            _exit(127);
        }
        answer = PyLong_FromLong(process);
#else
        PyErr_SetString(PyExc_NotImplementedError, "start_program is for Linux");
#endif
    }
    PyMem_Free(command);
    PyMem_Free(environment);
    return answer;
}

static PyMethodDef methods[] = {
    {"statuses_good", (PyCFunction)(void (*)(void))statuses_good, METH_FASTCALL, "statuses_good(answers, start, count, head, sequence)"},
    {"compose", (PyCFunction)(void (*)(void))compose, METH_FASTCALL, "compose(words, room, bank, points, polarities=None)"},
    {"null_places", (PyCFunction)(void (*)(void))null_places, METH_FASTCALL, "null_places(words, room, bank, points, nulls)"},
    {"pack_loads", (PyCFunction)(void (*)(void))pack_loads, METH_FASTCALL, "pack_loads(out, sequence, words)"},
    {"renumber_loads", (PyCFunction)(void (*)(void))renumber_loads, METH_FASTCALL, "renumber_loads(out, sequence, ready)"},
    {"unpack_loads", (PyCFunction)(void (*)(void))unpack_loads, METH_FASTCALL, "unpack_loads(words, ready)"},
    {"seal_short_frames", (PyCFunction)(void (*)(void))seal_short_frames, METH_FASTCALL, "seal_short_frames(out, start, count, sequence)"},
    {"start_program", (PyCFunction)(void (*)(void))start_program, METH_FASTCALL, "start_program(command, environment, standard_input)"},
    {NULL, NULL, 0, NULL},
};

static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, .m_name = MODULE, .m_size = -1, .m_methods = methods};

PyMODINIT_FUNC INITIALISE(void) {
    fill_tables();
    PyObject *made = PyModule_Create(&module);
    if (made && PyModule_AddIntConstant(made, "HAS_AVX2", MACHINE_HAS_AVX2)) Py_CLEAR(made);
    return made;
}
