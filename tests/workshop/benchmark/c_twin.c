/* The way of a touch report to the frames of an upload, in C: what the loop does in Python, for the same bytes.
 *
 * Events of protocol B are decoded, fingers tracked and predicted, regions and ways asked; then an upload is aimed,
 * its words are looked up, interpolated or composed, and packed into frames. Which of the fingers that are due is
 * played when, from which slot, under which number, is reported by the loop that runs beside (host_latency.py).
 */
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <time.h>

enum { CHANNELS = 32, SAMPLES = 1000, VALUES = CHANNELS * SAMPLES, FINGERS = 16, SLOTS = 16, POINTS = 10, CHUNKS = 8 };
enum { CHUNK_BYTES = 500, LOAD_BYTES = 512, SHORT_BYTES = 36, UPLOAD_BYTES = CHUNKS * LOAD_BYTES };
enum { AWAY = -1, UNKNOWN = -2, IMPLIED = -3 };

struct event { int64_t second, microsecond; uint16_t type, code; int32_t value; };

struct config {
    const uint8_t *drive;
    const int8_t *response;
    const int32_t *entry_of;
    const double *scale_of;
    const uint32_t *crc_of; /* of an entry's drive words */
    uint32_t (*crc32)(uint32_t, const uint8_t *, uint32_t);
    int64_t drive_stride, response_stride;
    int64_t nx, ny, regions, slots;
    double pitch_m, x0_m, y0_m, equaliser, band_lost, snap_m, near_m, lattice_m;
    double length_m, width_m, lag_s, max_size_m;
    double rectangle[16][4], spacing_m[16]; /* spacing 0: none */
    int64_t idle_word;
};

struct axes { double from[6], size_m; int64_t x_low, x_high, y_low, y_high; };
struct contact { int identity, x, y, has_x, has_y, moved, hovers, palm, size, finger, used; double x_m, y_m, size_m; };
struct sample { int finger, contact; double x_m, y_m, time_s, size_m; };
struct motion { double x_m, y_m, time_s, vx, vy, fx_m, fy_m, fvx, fvy, ax_m, ay_m; int rested; };
struct tracked { int number, finger, reports, played, refused; double first_s, lost_s; struct motion motion; };
struct state { int finger, region, due; double x_m, y_m, way_m, anchor_x_m, anchor_y_m; };
struct key { int known, cell, count; double x_m, y_m; long at[POINTS][2]; }; /* a place, or several on the lattice */

static struct config c;
static struct axes axes;
static struct contact slots[SLOTS];
static int order[SLOTS], used, here, touching, next_finger;
static struct { int finger; double x_m, y_m, size_m; } gone[FINGERS];
static int gones;
static struct tracked contacts[FINGERS], lost[FINGERS];
static int contact_count, lost_count;
static double period_s, last_report_s, known_s, due_s;
static int has_report;
static struct state states[FINGERS];
static int state_count;
static struct key resident[16];
static uint8_t sent[UPLOAD_BYTES + 8 * SHORT_BYTES];
static uint32_t words[SAMPLES];
static int16_t low_at[CHANNELS], flip[CHANNELS];

static int64_t now_ns(void)
{
    struct timespec at;
    clock_gettime(CLOCK_MONOTONIC, &at);
    return at.tv_sec * 1000000000LL + at.tv_nsec;
}

void twin_begin(const struct config *config)
{
    c = *config;
    for (int q = 0; q < CHANNELS; q++) {
        int high = c.idle_word >> q & 1;
        low_at[q] = -high;
        flip[q] = 1 - 2 * high;
    }
    period_s = 10e-3;
    due_s = INFINITY;
    touching = -1;
    next_finger = contact_count = lost_count = state_count = has_report = used = gones = 0;
    memset(resident, 0, sizeof resident);
    memset(slots, 0, sizeof slots);
}

static void enter(int slot)
{
    here = slot;
    if (!slots[slot].used) {
        memset(&slots[slot], 0, sizeof slots[slot]);
        slots[slot].used = 1;
        slots[slot].identity = UNKNOWN;
        slots[slot].finger = -1;
        order[used++] = slot;
    }
}

void twin_panel(const struct axes *of) /* another recording: a decoder again, the fingers' numbers go on */
{
    axes = *of;
    memset(slots, 0, sizeof slots);
    used = gones = 0;
    touching = -1;
    enter(0);
}

/* ---- tracking ---- */

static void motion_begin(struct motion *m, double x_m, double y_m, double time_s)
{
    memset(m, 0, sizeof *m);
    m->x_m = m->fx_m = m->ax_m = x_m;
    m->y_m = m->fy_m = m->ay_m = y_m;
    m->time_s = time_s;
}

static void motion_report(struct motion *m, double x_m, double y_m, double time_s)
{
    double step_s = time_s - m->time_s;
    if (step_s > 50e-3) {
        step_s = 50e-3;
        m->fvx = m->fvy = 0;
        m->fx_m = m->x_m;
        m->fy_m = m->y_m;
    } else if (step_s < 2e-3)
        step_s = 2e-3;
    double vx = m->fvx, vy = m->fvy;
    double ahead_x = m->fx_m + vx * step_s, ahead_y = m->fy_m + vy * step_s;
    double off_x = x_m - ahead_x, off_y = y_m - ahead_y;
    m->fx_m = ahead_x + 0.7 * off_x;
    m->fy_m = ahead_y + 0.7 * off_y;
    m->fvx = vx = vx + 0.4 / step_s * off_x;
    m->fvy = vy = vy + 0.4 / step_s * off_y;
    double step_x = x_m - m->x_m, step_y = y_m - m->y_m;
    double most = 1.5 * hypot(step_x, step_y) / step_s, speed = hypot(vx, vy);
    if (vx * step_x + vy * step_y <= 0)
        vx = vy = 0;
    else if (speed > most) {
        vx = vx * most / speed;
        vy = vy * most / speed;
    }
    m->vx = vx;
    m->vy = vy;
    m->x_m = x_m;
    m->y_m = y_m;
    m->time_s = time_s;
    if (hypot(x_m - m->ax_m, y_m - m->ay_m) <= 0.35e-3) {
        if (++m->rested == 8) {
            m->ax_m = m->fx_m;
            m->ay_m = m->fy_m;
        }
    } else {
        m->ax_m = x_m;
        m->ay_m = y_m;
        m->rested = 0;
    }
}

/* Silence counts up to `reported_s`, however far ahead `at_s` is. */
static void motion_place(const struct motion *m, double at_s, double reported_s, double lag_s, double *x_m, double *y_m)
{
    if (m->rested >= 8) {
        *x_m = m->ax_m;
        *y_m = m->ay_m;
        return;
    }
    double ahead_s = fmin(fmax(at_s - m->time_s, 0) + lag_s, 40e-3), silent_s = reported_s - m->time_s;
    if (silent_s > 1.5 * period_s)
        ahead_s *= fmax(2.5 - silent_s / period_s, 0) / (2.5 - 1.5);
    double ahead_m = hypot(m->vx, m->vy) * ahead_s;
    if (ahead_m > 20e-3)
        ahead_s *= 20e-3 / ahead_m;
    *x_m = m->x_m + m->vx * ahead_s;
    *y_m = m->y_m + m->vy * ahead_s;
}

/* ---- scene ---- */

static int region_at(double x_m, double y_m)
{
    for (int i = 0; i < c.regions; i++) {
        const double *r = c.rectangle[i];
        if (r[0] <= x_m && x_m <= r[2] && r[1] <= y_m && y_m <= r[3])
            return i;
    }
    return -1;
}

static void come_into(struct state *s, int region)
{
    s->region = region;
    s->way_m = 0;
    s->anchor_x_m = s->x_m;
    s->anchor_y_m = s->y_m;
}

static int crossed(struct state *s, double spacing_m)
{
    double rest_m = fmin(0.25e-3, spacing_m / 4);
    double step_m = hypot(s->x_m - s->anchor_x_m, s->y_m - s->anchor_y_m), way_m = s->way_m + step_m;
    if (way_m >= spacing_m - 1e-9) {
        s->way_m = fmax(fmod(way_m + 1e-9, spacing_m) - 1e-9, 0);
        s->anchor_x_m = s->x_m;
        s->anchor_y_m = s->y_m;
        return 1;
    }
    if (step_m >= rest_m) {
        s->way_m = way_m;
        s->anchor_x_m = s->x_m;
        s->anchor_y_m = s->y_m;
    }
    return 0;
}

static void touch(int finger, double x_m, double y_m, int contact)
{
    struct state *s = states, *end = states + state_count;
    while (s < end && s->finger != finger)
        s++;
    if (!contact) {
        if (s < end)
            *s = states[--state_count];
        return;
    }
    int region = region_at(x_m, y_m);
    if (s == end) {
        if (state_count == FINGERS)
            return;
        state_count++;
        s->finger = finger;
        s->x_m = x_m;
        s->y_m = y_m;
        come_into(s, region);
        s->due = region >= 0;
        return;
    }
    s->x_m = x_m;
    s->y_m = y_m;
    if (region != s->region)
        come_into(s, region);
    else if (region >= 0 && c.spacing_m[region] > 0 && crossed(s, c.spacing_m[region]))
        s->due = 1;
}

/* ---- one read of the tracker ---- */

/* The lost finger that a new contact is: of those that would be near by now, the nearest; -1: none. */
static int found_again(const struct sample *sample)
{
    int found = -1;
    double nearest_m = 5e-3;
    for (int i = 0; i < lost_count; i++) {
        const struct motion *m = &lost[i].motion;
        double x_m, y_m;
        motion_place(m, sample->time_s, m->time_s, 0, &x_m, &y_m);
        double off_m = hypot(sample->x_m - x_m, sample->y_m - y_m);
        if (off_m <= nearest_m && sample->time_s <= lost[i].lost_s + 1.5 * period_s) {
            found = i;
            nearest_m = off_m;
        }
    }
    return found;
}

static void track(const struct sample *sample)
{
    struct tracked *t = contacts, *end = contacts + contact_count;
    while (t < end && t->number != sample->finger)
        t++;
    if (!sample->contact) {
        if (t == end)
            return;
        struct tracked left = *t;
        memmove(t, t + 1, (end - t - 1) * sizeof *t);
        contact_count--;
        if (!left.refused && left.played && lost_count < FINGERS) {
            left.lost_s = sample->time_s;
            lost[lost_count++] = left;
        }
        return;
    }
    int palm = sample->size_m > c.max_size_m;
    if (t == end) {
        if (contact_count == FINGERS)
            return;
        contact_count++;
        int found = palm ? -1 : found_again(sample);
        if (found >= 0) {
            *t = lost[found];
            memmove(lost + found, lost + found + 1, (lost_count - found - 1) * sizeof *lost);
            lost_count--;
            t->lost_s = INFINITY;
            t->number = sample->finger;
        } else {
            memset(t, 0, sizeof *t);
            t->number = t->finger = sample->finger;
            t->reports = 1;
            t->refused = palm;
            t->first_s = sample->time_s;
            t->lost_s = INFINITY;
            motion_begin(&t->motion, sample->x_m, sample->y_m, sample->time_s);
            return;
        }
    }
    if (t->refused)
        return;
    if (palm) {
        t->refused = 1;
        if (t->played) {
            t->played = 0;
            touch(t->finger, 0, 0, 0);
        }
        return;
    }
    motion_report(&t->motion, sample->x_m, sample->y_m, sample->time_s);
    t->reports++;
    if (t->played)
        touch(t->finger, sample->x_m, sample->y_m, 1);
}

static void tracker_read(const struct sample *samples, int count, int reported, double now_s)
{
    known_s = count ? samples[0].time_s : now_s; /* more reports may wait behind this one */
    if (!count && !reported && now_s < due_s)
        return;
    for (int i = 0; i < count; i++)
        track(samples + i);
    if (reported) {
        if (has_report) {
            double step_s = known_s - last_report_s;
            int bin = (int)(step_s / 0.25e-3);
            if (0 < bin && bin < 256)
                period_s = fmin(fmax(period_s * (step_s > period_s ? 1 + 0.02 : 1 - 0.02), 2e-3), 25e-3);
        }
        has_report = 1;
        last_report_s = known_s;
        for (int i = 0; i < contact_count; i++) {
            struct tracked *t = contacts + i;
            if (t->motion.time_s < known_s && !t->refused) {
                motion_report(&t->motion, t->motion.x_m, t->motion.y_m, known_s);
                t->reports++;
            }
        }
    }
    due_s = INFINITY;
    for (int i = 0; i < lost_count;) {
        double until_s = lost[i].lost_s + 1.5 * period_s;
        if (known_s >= until_s) {
            touch(lost[i].finger, 0, 0, 0);
            memmove(lost + i, lost + i + 1, (lost_count - i - 1) * sizeof *lost);
            lost_count--;
        } else {
            due_s = fmin(due_s, until_s);
            i++;
        }
    }
    for (int i = 0; i < contact_count; i++) {
        struct tracked *t = contacts + i;
        if (t->played || t->refused)
            continue;
        t->played = 1;
        touch(t->finger, t->motion.x_m, t->motion.y_m, 1);
    }
    if (!contact_count)
        has_report = 0;
}

/* ---- decoding ---- */

static int down(const struct contact *k)
{
    return (k->identity >= 0 || k->identity == IMPLIED) && !k->hovers && touching != 0;
}

static struct sample released(struct contact *k, double time_s)
{
    struct sample s = {k->finger, 0, k->x_m, k->y_m, time_s, k->size_m};
    k->finger = -1;
    return s;
}

static int decode(const struct event *events, int count, double time_s, struct sample *samples, int *reported)
{
    int n = 0;
    for (int i = 0; i < count; i++) {
        const struct event *e = events + i;
        struct contact *k = slots + here;
        if (e->type == 3) {
            switch (e->code) {
            case 0x35:
                if (!k->has_x || e->value != k->x) { k->x = e->value; k->has_x = k->moved = 1; }
                if (k->identity == UNKNOWN) k->identity = IMPLIED;
                break;
            case 0x36:
                if (!k->has_y || e->value != k->y) { k->y = e->value; k->has_y = k->moved = 1; }
                if (k->identity == UNKNOWN) k->identity = IMPLIED;
                break;
            case 0x2f:
                if (0 <= e->value && e->value < SLOTS) enter(e->value);
                break;
            case 0x30: k->size = e->value; break;
            case 0x37: k->palm = e->value == 2; break;
            case 0x3b: k->hovers = e->value > 0; break;
            case 0x39: {
                int identity = e->value < 0 ? AWAY : e->value;
                if (identity == k->identity) break;
                if (k->finger >= 0) {
                    gone[gones].finger = k->finger;
                    gone[gones].x_m = k->x_m;
                    gone[gones].y_m = k->y_m;
                    gone[gones++].size_m = k->size_m;
                    k->finger = -1;
                }
                k->identity = identity;
                break;
            }
            }
        } else if (e->type == 1 && e->code == 0x14a)
            touching = e->value != 0;
    }
    for (int i = 0; i < gones; i++)
        samples[n++] = (struct sample){gone[i].finger, 0, gone[i].x_m, gone[i].y_m, time_s, gone[i].size_m};
    gones = 0;
    int fingers_down = 0;
    for (int i = 0; i < used; i++) {
        struct contact *k = slots + order[i];
        if (!down(k)) {
            if (k->finger >= 0) samples[n++] = released(k, time_s);
            continue;
        }
        fingers_down++;
        if (k->palm && k->finger >= 0) samples[n++] = released(k, time_s);
    }
    *reported = fingers_down > 0;
    for (int i = 0; i < used; i++) {
        struct contact *k = slots + order[i];
        if (!(k->moved || k->finger < 0) || !k->has_x || !k->has_y || k->palm || !down(k))
            continue;
        if (k->finger < 0) k->finger = next_finger++;
        int64_t x = k->x < axes.x_low ? axes.x_low : k->x > axes.x_high ? axes.x_high : k->x;
        int64_t y = k->y < axes.y_low ? axes.y_low : k->y > axes.y_high ? axes.y_high : k->y;
        k->x_m = fmin(fmax(axes.from[0] * x + axes.from[1] * y + axes.from[2], 0), c.length_m);
        k->y_m = fmin(fmax(axes.from[3] * x + axes.from[4] * y + axes.from[5], 0), c.width_m);
        k->size_m = k->size > 0 ? k->size * axes.size_m : 0;
        k->moved = 0;
        samples[n++] = (struct sample){k->finger, 1, k->x_m, k->y_m, time_s, k->size_m};
    }
    return n;
}

/* One read: a report's events, or none; how long it took. */
int64_t twin_read(const struct event *events, int count, double now_s)
{
    int64_t began_ns = now_ns();
    struct sample samples[2 * FINGERS];
    int n = 0, reported = 0;
    if (count) {
        const struct event *last = events + count - 1;
        double time_s = fmin(last->second + last->microsecond * 1e-6, now_s);
        n = decode(events, count - 1, time_s, samples, &reported);
    }
    tracker_read(samples, n, reported, now_s);
    return now_ns() - began_ns;
}

/* ---- an upload ---- */

static double along(double distance_m, int64_t last, int64_t *index)
{
    double millionths = rint(distance_m / c.pitch_m * 1e6);
    *index = 0;
    if (millionths <= 0) return 0;
    int64_t all = (int64_t)millionths;
    *index = all / 1000000;
    if (*index >= last) { *index = last; return 0; }
    return (all % 1000000) * 1e-6;
}

struct patch { const int8_t *from[4]; int16_t weight[4], rest_weight[4]; int cells, tap; };

static void patch_at(double x_m, double y_m, struct patch *p)
{
    int64_t ix, iy;
    double right = along(x_m - c.x0_m, c.nx - 1, &ix), up = along(y_m - c.y0_m, c.ny - 1, &iy);
    int columns = right ? 2 : 1, rows_ = up ? 2 : 1;
    double between = right * (1 - right) + up * (1 - up), share[4], total = 0, vertical[2] = {1 - up, up}, horizontal[2] = {1 - right, right};
    p->cells = 0;
    p->tap = (int)rint(c.equaliser * between * (1 << 14));
    for (int row = 0; row < rows_; row++)
        for (int column = 0; column < columns; column++) {
            int entry = c.entry_of[(iy + row) * c.nx + ix + column];
            p->from[p->cells] = c.response + (int64_t)entry * c.response_stride;
            share[p->cells] = vertical[row] * horizontal[column] * c.scale_of[entry];
            total += share[p->cells++];
        }
    double unit = total ? 256 / total : 0;
    for (int i = 0; i < p->cells; i++) {
        p->weight[i] = (int16_t)rint(share[i] * unit);
        p->rest_weight[i] = (int16_t)rint(share[i] * (unit * (1 - c.band_lost * between)));
    }
    if (p->cells == 1) p->weight[0] = p->rest_weight[0] = 256;
    for (int i = p->cells; i < 4; i++) p->from[i] = p->from[0];
}

/* What the bits do outside the band: means of two samples, behind the response in the band. */
enum { RESTS = VALUES / 2 };
static int16_t rest_of[POINTS][RESTS];

static void take_rest(const struct patch *p, int16_t *out)
{
    const int8_t *a = p->from[0] + VALUES, *b = p->from[1] + VALUES, *d = p->from[2] + VALUES, *e = p->from[3] + VALUES;
    int16_t weight[4] = {0};
    for (int cell = 0; cell < p->cells; cell++) weight[cell] = p->rest_weight[cell];
    for (int n = 0; n < RESTS; n += CHANNELS)
        for (int q = 0; q < CHANNELS; q++)
            out[n + q] = (int16_t)((a[n + q] * weight[0] + b[n + q] * weight[1] + d[n + q] * weight[2] + e[n + q] * weight[3]) * flip[q]);
}

/* Halved, with what interpolation takes from short waves given back, 8 us before and after; the sum of absolute values in the band. */
enum { APART = 4 * CHANNELS };

static int64_t equalise(int tap, int16_t *response, int16_t *rest)
{
    static int16_t met[VALUES + 2 * APART];
    int64_t size = 0;
    memcpy(met + APART, response, VALUES * sizeof *met);
    for (int v = 0; v < RESTS; v++) rest[v] >>= 1;
    for (int n = 0; n < VALUES; n += CHANNELS) {
        int32_t part = 0;
        for (int v = n; v < n + CHANNELS; v++) {
            response[v] = (int16_t)((met[v + APART] >> 1) - (met[v] * tap >> 15) - (met[v + 2 * APART] * tap >> 15));
            part += response[v] < 0 ? -response[v] : response[v];
        }
        size += part;
    }
    return size;
}

/* Samples 0, 3, 6, .. of a response. */
enum { STEP = 3, SKETCH = (SAMPLES + STEP - 1) / STEP * CHANNELS };
static int16_t sketch_of[POINTS][SKETCH];
static int32_t sum_all[VALUES];
static int16_t bit_all[VALUES], bits_of_two[RESTS];

static void sketch(const int16_t *response, int16_t *out)
{
    for (int n = 0; n < SAMPLES; n += STEP, out += CHANNELS)
        for (int q = 0; q < CHANNELS; q++) out[q] = response[n * CHANNELS + q] >> 4;
}

static int64_t inner_product(const int16_t *a, const int16_t *b)
{
    int64_t sum = 0;
    for (int v = 0; v < SKETCH; v += 256) { /* 256 products of 22 bits */
        int32_t part = 0, end = v + 256 < SKETCH ? v + 256 : SKETCH;
        for (int k = v; k < end; k++) part += a[k] * b[k];
        sum += part;
    }
    return sum;
}

/* Whole numbers that sum to 32767. */
static void whole_weights(const double *divisor, const double *weight, int count, int16_t *whole)
{
    double total = 0;
    for (int i = 0; i < count; i++) total += fabs(weight[i] / divisor[i]);
    for (int i = 0; i < count; i++) whole[i] = (int16_t)rint(weight[i] / divisor[i] * (32767 / total));
}

/* Bits of a sum of `length` values of responses with these weights. */
static void bits_of_sum(const int16_t *const *response, const int16_t *weight, int count, int length)
{
    for (int v = 0; v < length; v++) sum_all[v] = weight[0] * response[0][v];
    for (int i = 1; i < count; i++)
        for (int v = 0; v < length; v++) sum_all[v] += weight[i] * response[i][v];
    for (int v = 0; v < length; v++) bit_all[v] = sum_all[v] > 0;
}

/* 32,000 values of 15 bits at most, or 16,000 of 16 */
static int32_t total_of_bits(const int16_t *values, const int16_t *bits, int length)
{
    int32_t sum = 0;
    for (int v = 0; v < length; v++) sum += values[v] * bits[v];
    return sum;
}

/* Divide weights by what their points got. */
static void correct(const double *share, int count, double *balance)
{
    double mean = 0;
    for (int i = 0; i < count; i++) mean += share[i];
    mean /= count;
    for (int i = 0; i < count; i++) balance[i] *= share[i] > 0 ? fmin(fmax(mean / share[i], 0.5), 2) : 2;
}

/* Balance weights in the sketches, then with all that bits do. */
static void balanced(const double *divisor, const int16_t *const *response, int count, double *balance)
{
    const int16_t *sketches[POINTS] = {0};
    int16_t weight[POINTS];
    double share[POINTS] = {0};
    for (int i = 0; i < count; i++) sketches[i] = sketch_of[i];
    whole_weights(divisor, balance, count, weight);
    bits_of_sum(sketches, weight, count, SKETCH);
    for (int i = 0; i < count; i++) share[i] = total_of_bits(sketches[i], bit_all, SKETCH) / divisor[i];
    correct(share, count, balance);
    for (int round = 0; round < (count > 4 ? 2 : 1); round++) {
        whole_weights(divisor, balance, count, weight);
        bits_of_sum(response, weight, count, VALUES);
        for (int n = 0; n < RESTS; n += CHANNELS)
            for (int q = 0; q < CHANNELS; q++) {
                const int16_t *two = bit_all + 2 * n + q;
                bits_of_two[n + q] = two[0] + two[CHANNELS];
            }
        for (int i = 0; i < count; i++)
            share[i] = ((double)total_of_bits(response[i], bit_all, VALUES) + total_of_bits(rest_of[i], bits_of_two, RESTS)) / divisor[i];
        correct(share, count, balance);
    }
}

/* Weights of responses, of the sums of whose absolute values: polarities with which the energy of the sum is largest, then balanced
   so that all points get the same share. */
static void weigh(const int64_t *size, const int16_t *const *response, int count, int16_t *weight)
{
    double divisor[POINTS], product[POINTS][POINTS], balance[POINTS], largest = 0;
    int64_t whole[POINTS][POINTS] = {{0}}, most = INT64_MIN;
    int best = 0, negative = 0;
    for (int i = 0; i < count; i++) {
        divisor[i] = size[i] ? (double)size[i] : INFINITY;
        balance[i] = 1;
        sketch(response[i], sketch_of[i]);
        for (int j = 0; j < i; j++) {
            product[i][j] = (double)inner_product(sketch_of[i], sketch_of[j]) / divisor[i] / divisor[j];
            if (fabs(product[i][j]) > largest) largest = fabs(product[i][j]);
        }
    }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < i; j++) whole[i][j] = largest ? (int64_t)rint(product[i][j] * ((1 << 30) / largest)) : 0;
    for (int choice = 0; choice < 1 << (count - 1); choice++) {
        int64_t energy = 0;
        for (int i = 0; i < count; i++)
            for (int j = 0; j < i; j++) energy += ((choice << 1 >> i ^ choice << 1 >> j) & 1) ? -whole[i][j] : whole[i][j];
        if (energy > most) {
            most = energy;
            best = choice;
        }
    }
    for (int i = 0; i < count; i++) negative += best << 1 >> i & 1;
    for (int i = 0; i < count; i++)
        if ((best << 1 >> i & 1) != (2 * negative > count)) divisor[i] = -divisor[i];
    balanced(divisor, response, count, balance);
    whole_weights(divisor, balance, count, weight);
}

/* Words of a place and of several places: plain loops, or by -DVECTORS vectors of 128 bits, which are SSE and NEON alike. */
#ifdef VECTORS

typedef int8_t i8x16 __attribute__((vector_size(16), aligned(1), may_alias));
typedef uint8_t u8x16 __attribute__((vector_size(16)));
typedef int16_t i16x8 __attribute__((vector_size(16)));
typedef uint16_t u16x8 __attribute__((vector_size(16)));
typedef int32_t i32x4 __attribute__((vector_size(16)));
typedef uint64_t u64x2 __attribute__((vector_size(16)));
enum { PER = 8, GROUPS = CHANNELS / PER }; /* vectors of one sample */

static i16x8 rows[POINTS][VALUES / PER];

/* 16 levels, eight at a time: each the upper byte of 16 bits, and shifted down */
#define LOW(levels) ((i16x8)__builtin_shuffle((u8x16){0}, (u8x16)(levels), (u8x16){0, 16, 0, 17, 0, 18, 0, 19, 0, 20, 0, 21, 0, 22, 0, 23}) >> 8)
#define HIGH(levels) ((i16x8)__builtin_shuffle((u8x16){0}, (u8x16)(levels), (u8x16){0, 24, 0, 25, 0, 26, 0, 27, 0, 28, 0, 29, 0, 30, 0, 31}) >> 8)
#define LEVELS(cell, at) (*(const i8x16 *)(p->from[cell] + (at)))

/* Four cells at most: sixteen values of their weighted sum. */
static inline void sixteen(const struct patch *p, int at, i16x8 out[2])
{
    i8x16 levels = LEVELS(0, at);
    out[0] = LOW(levels) * p->weight[0];
    out[1] = HIGH(levels) * p->weight[0];
    for (int cell = 1; cell < p->cells; cell++) {
        levels = LEVELS(cell, at);
        out[0] += LOW(levels) * p->weight[cell];
        out[1] += HIGH(levels) * p->weight[cell];
    }
}

/* Sixteen comparisons, 0 or -1, as sixteen bits */
static inline uint32_t sixteen_bits(i16x8 low, i16x8 high)
{
    u64x2 ones = (u64x2)(__builtin_shuffle((u8x16)low, (u8x16)high, (u8x16){0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30}) & 1);
    return (uint32_t)(ones[0] * 0x0102040810204080ULL >> 56) | (uint32_t)(ones[1] * 0x0102040810204080ULL >> 56) << 8;
}

static void interpolate(double x_m, double y_m)
{
    struct patch patch, *p = &patch;
    i16x8 above[GROUPS], v[2];
    memcpy(above, low_at, sizeof above);
    patch_at(x_m, y_m, p);
    for (int n = 0; n < SAMPLES; n++) {
        uint32_t word = 0;
        for (int half = 0; half < 2; half++) {
            sixteen(p, n * CHANNELS + 16 * half, v);
            word |= sixteen_bits(v[0] > above[2 * half], v[1] > above[2 * half + 1]) << 16 * half;
        }
        words[n] = word;
    }
}

static void compose(const double (*points)[2], int count)
{
    i16x8 flips[GROUPS];
    int16_t weight[POINTS];
    int64_t size[POINTS] = {0};
    const int16_t *response[POINTS];
    memcpy(flips, flip, sizeof flips);
    for (int i = 0; i < count; i++) {
        struct patch patch, *p = &patch;
        patch_at(points[i][0], points[i][1], p);
        take_rest(p, rest_of[i]);
        for (int n = 0; n < SAMPLES; n++)
            for (int half = 0; half < 2; half++) {
                i16x8 *v = rows[i] + n * GROUPS + 2 * half;
                sixteen(p, n * CHANNELS + 16 * half, v);
                for (int k = 0; k < 2; k++) v[k] *= flips[2 * half + k];
            }
        size[i] = equalise(p->tap, (int16_t *)rows[i], rest_of[i]);
    }
    for (int i = 0; i < count; i++) response[i] = (const int16_t *)rows[i];
    weigh(size, response, count, weight);
    for (int n = 0; n < SAMPLES; n++) {
        uint32_t word = 0;
        for (int half = 0; half < 2; half++) {
            i16x8 bits[2];
            for (int k = 0; k < 2; k++) {
                i32x4 total[2] = {{0}, {0}};
                for (int i = 0; i < count; i++) {
                    i16x8 v = rows[i][n * GROUPS + 2 * half + k], zero = {0};
                    i32x4 first = (i32x4)__builtin_shuffle(zero, v, (i16x8){0, 8, 0, 9, 0, 10, 0, 11}) >> 16;
                    i32x4 last = (i32x4)__builtin_shuffle(zero, v, (i16x8){0, 12, 0, 13, 0, 14, 0, 15}) >> 16;
                    total[0] += weight[i] * first;
                    total[1] += weight[i] * last;
                }
                bits[k] = __builtin_shuffle((i16x8)(total[0] > 0), (i16x8)(total[1] > 0), (i16x8){0, 2, 4, 6, 8, 10, 12, 14});
            }
            word |= sixteen_bits(bits[0], bits[1]) << 16 * half;
        }
        words[n] = word ^ (uint32_t)c.idle_word;
    }
}

#else

static int16_t sum_of[VALUES], rows[POINTS][VALUES];
static uint8_t bits_of[VALUES];
static int32_t total_of[VALUES];

static void add_up(const struct patch *p)
{
    const int8_t *a = p->from[0], *b = p->from[1], *d = p->from[2], *e = p->from[3];
    int16_t wa = p->weight[0], wb = p->weight[1], wd = p->weight[2], we = p->weight[3];
    if (p->cells == 4)
        for (int i = 0; i < VALUES; i++) sum_of[i] = (int16_t)(a[i] * wa) + (int16_t)(b[i] * wb) + (int16_t)(d[i] * wd) + (int16_t)(e[i] * we);
    else if (p->cells == 2)
        for (int i = 0; i < VALUES; i++) sum_of[i] = (int16_t)(a[i] * wa) + (int16_t)(b[i] * wb);
    else
        for (int i = 0; i < VALUES; i++) sum_of[i] = (int16_t)(a[i] * wa);
}

static void pack(uint32_t turned)
{
    for (int n = 0; n < SAMPLES; n++) {
        uint64_t eights[4];
        uint32_t word = 0;
        memcpy(eights, bits_of + n * CHANNELS, sizeof eights);
        for (int k = 0; k < 4; k++) word |= (uint32_t)(eights[k] * 0x0102040810204080ULL >> 56) << 8 * k;
        words[n] = word ^ turned;
    }
}

static void interpolate(double x_m, double y_m)
{
    struct patch p;
    patch_at(x_m, y_m, &p);
    add_up(&p);
    for (int n = 0; n < SAMPLES; n++)
        for (int q = 0; q < CHANNELS; q++) bits_of[n * CHANNELS + q] = sum_of[n * CHANNELS + q] > low_at[q];
    pack(0);
}

static void compose(const double (*points)[2], int count)
{
    int64_t size[POINTS] = {0};
    const int16_t *response[POINTS];
    int16_t weight[POINTS];
    for (int i = 0; i < count; i++) {
        struct patch p;
        patch_at(points[i][0], points[i][1], &p);
        take_rest(&p, rest_of[i]);
        add_up(&p);
        for (int v = 0; v < VALUES; v++) rows[i][v] = (int16_t)(sum_of[v] * flip[v % CHANNELS]);
        size[i] = equalise(p.tap, rows[i], rest_of[i]);
    }
    for (int i = 0; i < count; i++) response[i] = (const int16_t *)rows[i];
    weigh(size, response, count, weight);
    for (int i = 0; i < count; i++)
        if (i)
            for (int v = 0; v < VALUES; v++) total_of[v] += weight[i] * rows[i][v];
        else
            for (int v = 0; v < VALUES; v++) total_of[v] = weight[i] * rows[i][v];
    for (int v = 0; v < VALUES; v++) bits_of[v] = total_of[v] > 0;
    pack((uint32_t)c.idle_word);
}

#endif

static void put16(uint8_t *at, uint32_t value) { at[0] = value; at[1] = value >> 8; }
static void put32(uint8_t *at, uint32_t value) { memcpy(at, &value, 4); }

static uint8_t *frame(uint8_t *at, int type, int sequence, int payload, int argument)
{
    put16(at, 0xa55a);
    at[2] = type;
    at[3] = sequence;
    put16(at + 4, payload);
    put16(at + 6, argument);
    if (type != 3) memset(at + 8, 0, payload);
    return at + 8;
}

static uint8_t *seal(uint8_t *start, int size)
{
    put32(start + size, c.crc32(0, start, size));
    return start + size + 4;
}

/* PLAY, behind a STOP and `nops`, and the NOP that fetches its result; the end of it all. */
static uint8_t *play(uint8_t *at, int sequence, int slot, int stop, int nops, int count, int start, uint32_t period_ticks,
                     uint64_t when_ticks)
{
    if (stop) {
        put32(frame(at, 2, sequence++, 24, 8), stop); /* register CONTROL */
        at = seal(at, 32);
    }
    for (int k = 0; k < nops; k++) {
        frame(at, 0, sequence++, 24, 0);
        at = seal(at, 32);
    }
    uint8_t *p = frame(at, 5, sequence++, 24, slot); /* first, length, count, start, inverted, period, mask, when */
    put16(p + 4, count);
    p[6] = start;
    put32(p + 8, period_ticks);
    put32(p + 12, 0xffffffff);
    memcpy(p + 16, &when_ticks, 8);
    at = seal(at, 32);
    frame(at, 0, sequence, 24, 0);
    return seal(at, 32);
}

static uint8_t *upload(const uint8_t *payload, int64_t stride, uint32_t crc, int sequence, int slot)
{
    uint8_t *at = sent;
    for (int k = 0; k < CHUNKS; k++) {
        memcpy(frame(at, 3, sequence++, CHUNK_BYTES, k), payload + k * stride, CHUNK_BYTES);
        at = seal(at, 8 + CHUNK_BYTES);
    }
    uint8_t *p = frame(at, 4, sequence++, 24, slot);
    put32(p, SAMPLES);
    put32(p + 4, crc);
    return seal(at, 32);
}

static struct tracked *finger_of(int finger)
{
    for (int i = 0; i < contact_count; i++)
        if (contacts[i].played && contacts[i].finger == finger) return contacts + i;
    for (int i = 0; i < lost_count; i++)
        if (lost[i].finger == finger) return lost + i;
    return 0;
}

/* The lattice of several points is finer. */
static double lattice_of(int count) { return count == 1 ? c.lattice_m : c.lattice_m / 8; }

/* What fingers are due, and the key of where they will be; 0, or -1: one was not due here, -2: it is not known here. */
static int aim(const int *fingers, int count, double focus_s, struct key *key)
{
    memset(key, 0, sizeof *key);
    key->known = 1;
    key->count = count;
    key->cell = -1;
    for (int i = 0; i < count; i++) {
        struct state *s = states, *end = states + state_count;
        while (s < end && s->finger != fingers[i]) s++;
        if (s < end) {
            if (!s->due) return -1;
            s->due = 0;
        }
        struct tracked *t = finger_of(fingers[i]);
        if (!t) return -2;
        double x_m = t->motion.x_m, y_m = t->motion.y_m;
        if (t->lost_s == INFINITY) motion_place(&t->motion, focus_s, known_s, c.lag_s, &x_m, &y_m);
        x_m = fmin(fmax(x_m, 0), c.length_m);
        y_m = fmin(fmax(y_m, 0), c.width_m);
        if (count == 1) {
            double ix = fmin(fmax(rint((x_m - c.x0_m) / c.pitch_m), 0), c.nx - 1);
            double iy = fmin(fmax(rint((y_m - c.y0_m) / c.pitch_m), 0), c.ny - 1);
            if (hypot(x_m - c.x0_m - ix * c.pitch_m, y_m - c.y0_m - iy * c.pitch_m) <= c.snap_m) {
                key->cell = (int)(iy * c.nx + ix);
                key->x_m = c.x0_m + ix * c.pitch_m;
                key->y_m = c.y0_m + iy * c.pitch_m;
                return 0;
            }
        }
        long x = lrint(x_m / lattice_of(count)), y = lrint(y_m / lattice_of(count));
        int j = i; /* in the order of their places */
        for (; j && (key->at[j - 1][0] > x || (key->at[j - 1][0] == x && key->at[j - 1][1] > y)); j--)
            memcpy(key->at[j], key->at[j - 1], sizeof *key->at);
        key->at[j][0] = x;
        key->at[j][1] = y;
    }
    key->x_m = key->at[0][0] * lattice_of(count);
    key->y_m = key->at[0][1] * lattice_of(count);
    return 0;
}

/* The slot that holds a waveform for this key; -1: none that is known here. */
static int find(const struct key *key)
{
    for (int i = 0; i < c.slots; i++)
        if (resident[i].known && resident[i].count == key->count) {
            int same = key->count == 1 ? hypot(resident[i].x_m - key->x_m, resident[i].y_m - key->y_m) <= c.near_m
                                       : !memcmp(resident[i].at, key->at, sizeof key->at);
            if (same) return i;
        }
    return -1;
}

/* What stands in a message besides waveforms, as the loop has decided it; nothing here follows from reports. */
struct reported { double focus_s; int slot, sequence, stop, nops, count, start; uint32_t period_ticks; uint64_t when_ticks; };

/* A play from a slot; how long it took, or the error of `aim`. */
int64_t twin_play(const int *fingers, int count, const struct reported *reported)
{
    int64_t began_ns = now_ns();
    struct key key;
    int error = aim(fingers, count, reported->focus_s, &key);
    if (error) return error;
    find(&key); /* what was sent ahead, and what is near enough, is the loop's to judge: the slot is reported */
    play(sent, reported->sequence, reported->slot, reported->stop, 0, reported->count, reported->start, reported->period_ticks, reported->when_ticks);
    return now_ns() - began_ns;
}

/* An upload and its play; how long it took, or the error of `aim`. */
int64_t twin_upload(const int *fingers, int count, const struct reported *reported)
{
    int64_t began_ns = now_ns();
    const uint8_t *payload = (const uint8_t *)words;
    int64_t stride = CHUNK_BYTES;
    struct key key;
    uint32_t crc;
    int error = aim(fingers, count, reported->focus_s, &key);
    if (error) return error;
    find(&key);
    if (key.cell >= 0) {
        payload = c.drive + c.entry_of[key.cell] * c.drive_stride + 8; /* in the bank's frames; headers and CRCs are made again */
        stride = CHUNK_BYTES + 12;
        crc = c.crc_of[c.entry_of[key.cell]];
    } else {
        double points[POINTS][2];
        for (int i = 0; i < count; i++) {
            points[i][0] = key.at[i][0] * lattice_of(count);
            points[i][1] = key.at[i][1] * lattice_of(count);
        }
        if (count == 1)
            interpolate(key.x_m, key.y_m);
        else
            compose((const double(*)[2])points, count);
        crc = c.crc32(0, payload, 4 * SAMPLES);
    }
    resident[reported->slot] = key;
    play(upload(payload, stride, crc, reported->sequence, reported->slot), reported->sequence + CHUNKS + 1, reported->slot, reported->stop, reported->nops,
         reported->count, reported->start, reported->period_ticks, reported->when_ticks);
    return now_ns() - began_ns;
}

const uint8_t *twin_sent(void) { return sent; }
