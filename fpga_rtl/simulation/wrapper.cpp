// haptic_core as a shared library: the clock, an SPI controller and a recorder, so that whoever loads it
// (controller/workshop/gateware/rtl_gateware.py) moves whole frames and whole captures and never a single clock.
// A tick is a clock since reset: inputs set at tick t are sampled by the edge that ends it, outputs of
// tick t are on the pins after the edge that begins it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "Vhaptic_core.h"
#if __has_include("Vhaptic_core__Dpi.h")
#include "Vhaptic_core__Dpi.h"
#define LEAPS 1  // leap.sv is part of it
#endif
#include "verilated.h"
#if VM_TRACE
#include "verilated_fst_c.h"
#endif

double sc_time_stamp() { return 0; }  // wanted by Verilator's run time

namespace {

constexpr uint64_t SELECT_TO_SCK_TICKS = 5, SCK_TICKS = 2, SCK_TO_RELEASE_TICKS = 3;  // as in controller/workshop/gateware/pin_timing.py
constexpr int RESET_CLOCKS = 4;
constexpr uint64_t NEVER = UINT64_MAX;
enum Pin : uint32_t { TRIGGER = 0, RUN_PERMIT = 1, TEMPERATURE_OK = 2, UART_RX = 3 };
constexpr int LINES = 5;  // lines of which every change is recorded: as of `lines`

struct Change {
    Pin pin;
    bool level;
};

class Panel {
public:
    Panel() : core_{&context_} {
        core_.spi_cs_n_i = 1;
        core_.uart_rx_i = 1;
        core_.rst_i = 1;
#if VM_TRACE
        context_.traceEverOn(true);
#endif
        core_.eval();
#if LEAPS
        scope_ = svGetScopeFromName("TOP.haptic_core.leap");
#endif
        for (int i = 0; i < RESET_CLOCKS; ++i) clock();
        core_.rst_i = 0;
    }

    // A model's names belong to the thread's context, which is that of whichever ran last, and may be gone
    ~Panel() {
        Verilated::threadContextp(&context_);
        core_.final();
    }

#if VM_TRACE
    // Write the ticks from `from` to `to` to an FST file, whose unit is a ps: the pins and what frame_view.sv says, or all signals.
    // False if the file cannot be written.
    bool trace(const char *path, double tick_ps, uint64_t from, uint64_t to, bool inside) {
        core_.trace(&fst_, 99);
        fst_.set_time_unit("1ps");
        fst_.set_time_resolution("1ps");
        if (!inside) {
            fst_.dumpvars(1, "TOP");
            fst_.dumpvars(1, "TOP.haptic_core.frames");
        }
        half_tick_ps_ = tick_ps / 2, from_ = from, to_ = to;
        fst_.open(path);
        return fst_.isOpen();
    }

    void close_trace() { fst_.close(); }
#endif

    uint64_t now() const { return now_; }

    // Inputs but for the link's; of one pin in the order of their ticks
    void set(Pin pin, uint64_t tick, bool level) {
        inputs_.emplace(tick, Change{pin, level});
        next_input_ = inputs_.begin()->first;
    }

    void run(uint64_t tick) {
        while (now_ < tick) {
            if (next_input_ <= now_) apply();
            if (sck_ != core_.spi_sck_i) edge();
            pass(std::min(tick, next_input_) - now_);
        }
    }

    void exchange(uint64_t select, uint64_t release, size_t size, const uint8_t *mosi, uint8_t *miso) {
        const uint64_t bits = 8 * size, room = release - select - SELECT_TO_SCK_TICKS - (SCK_TO_RELEASE_TICKS - SCK_TICKS);
        const auto rise = [=](uint64_t bit) { return select + SELECT_TO_SCK_TICKS + bit * room / bits; };
        std::fill_n(miso, size, uint8_t{0});
        run(select);
        drive(core_.spi_cs_n_i, 0);
        for (uint64_t bit = 0; bit < bits; ++bit) {
            core_.spi_mosi_i = mosi[bit / 8] >> (7 - bit % 8) & 1;
            run(rise(bit));
            miso[bit / 8] |= core_.spi_miso_o << (7 - bit % 8);
            sck_ = 1;
            sees_ = bit % 8 == 0 || bit % 8 == 7;
            run((rise(bit) + rise(bit + 1)) / 2);
            sck_ = 0;
        }
        run(release);
        drive(core_.spi_cs_n_i, 1);
    }

    // The link's pins tick by tick, for everything that is no proper frame: bit 0 chip select, 1 SCK, 2 MOSI; MISO behind each tick
    void wave(size_t ticks, const uint8_t *levels, uint8_t *miso) {
        for (size_t i = 0; i < ticks; ++i) {
            drive(core_.spi_cs_n_i, levels[i] & 1);
            core_.spi_mosi_i = levels[i] >> 2 & 1;
            sck_ = levels[i] >> 1 & 1;
            sees_ = true;
            run(now_ + 1);
            miso[i] = core_.spi_miso_o;
        }
    }

    std::vector<uint64_t> ticks, focus_ticks;  // of changes on channel_o or hv_enable_o; of rises of focus_o
    std::vector<uint64_t> changes[LINES];      // of hv_alive_o, waiting_o, fault_o, spi_miso_o and uart_tx_o, whose ticks these are
    std::vector<uint32_t> words;
    std::vector<uint8_t> levels;

private:
#if VM_TRACE
    // The clock that ends a tick, with which inputs were set at its fall, in the middle
    void clock() {
        core_.clk_i = 0;
        core_.eval();
        dump(1);
        core_.clk_i = 1;
        core_.eval();
        dump(2);
    }

    void dump(uint64_t half) {
        if (from_ <= now_ && now_ < to_) fst_.dump(static_cast<uint64_t>((2 * now_ + half) * half_tick_ps_));
    }

    VerilatedFstC fst_;
    double half_tick_ps_ = 0;
    uint64_t from_ = NEVER, to_ = 0;
#else
    // A rise of the clock, with which all inputs are seen that were set before; nothing happens at its fall
    void clock() {
        core_.clk_i = 1;
        core_.eval();
        core_.clk_i = 0;
        core_.eval();
    }
#endif

    // Ticks of a rest, in which nothing but counters moves, at once: they are owed, and need no clock yet. Else one.
    void pass(uint64_t most) {
        if (!rests()) {
            clock();
            record(++now_);
            return;
        }
        most = std::min(most, rest_);
        now_ += most;
        owed_ += most;
        rest_ -= most;
    }

    bool rests() {
#if LEAPS
        if (!rest_) {
            settle();
            rest_ = Vhaptic_core::rest();
        }
#endif
        return rest_;
    }

    // Add what the clocks that were left out would have
    void settle() {
#if LEAPS
        svSetScope(scope_);
        if (owed_) Vhaptic_core::pass(uint32_t(owed_));
        owed_ = 0;
#endif
    }

    // A pin that clk samples: with another level a rest is over
    void drive(CData &pin, CData level) {
        if (pin == level) return;
        settle();
        rest_ = 0;
        pin = level;
    }

    // An edge of SCK with the next clock. In a rest it comes alone, and behind that clock where it is a rise that clk sees.
    void edge() {
        const bool alone = rests();
        if (alone && sck_ && sees_) {
            ++owed_;
            settle();
            owed_ = -1;
            rest_ = 1;
        }
        core_.spi_sck_i = sck_;
        if (!alone) return;
        core_.eval();
        record(now_ + 1);
    }

    uint8_t &level_of(Pin pin) {
        switch (pin) {
        case TRIGGER: return core_.trigger_i;
        case RUN_PERMIT: return core_.run_permit_i;
        case TEMPERATURE_OK: return core_.temperature_ok_i;
        default: return core_.uart_rx_i;
        }
    }

    void apply() {
        for (auto input = inputs_.begin(); input != inputs_.end() && input->first <= now_; input = inputs_.erase(input))
            drive(level_of(input->second.pin), input->second.level);
        next_input_ = inputs_.empty() ? NEVER : inputs_.begin()->first;
    }

    void record(uint64_t tick) {
        if (core_.channel_o != word_ || core_.hv_enable_o != level_) {
            ticks.push_back(tick);
            words.push_back(word_ = core_.channel_o);
            levels.push_back(level_ = core_.hv_enable_o);
        }
        if (core_.focus_o && !focus_) focus_ticks.push_back(tick);
        focus_ = core_.focus_o;
        const uint32_t lines = core_.hv_alive_o | core_.waiting_o << 1 | core_.fault_o << 2 | core_.spi_miso_o << 3 | core_.uart_tx_o << 4;
        if (lines != lines_) {
            for (int line = 0; line < LINES; ++line)
                if ((lines ^ lines_) >> line & 1) changes[line].push_back(tick);
            lines_ = lines;
        }
    }

    VerilatedContext context_;
    Vhaptic_core core_;
    uint64_t now_ = 0;
    std::multimap<uint64_t, Change> inputs_;  // not yet on the pins
    uint64_t next_input_ = NEVER;
#if LEAPS
    svScope scope_;
#endif
    CData sck_ = 0;                 // as it is from the next clock on
    bool sees_ = true;              // of its rises, this one brings something to what clk clocks: the first and last bit of a byte
    uint64_t rest_ = 0;             // ticks of a rest that are to come
    int64_t owed_ = 0;              // ticks that have passed and that no counter has counted yet; -1: one is counted that is to come
    uint32_t word_ = 0, lines_ = 1 << 4;
    uint8_t level_ = 0, focus_ = 0;
};

template <typename T>
void move_to(T *target, std::vector<T> &source) {
    std::copy(source.begin(), source.end(), target);
    source.clear();
}

}  // namespace

extern "C" {
#pragma GCC visibility push(default)

Panel *panel_open() { return new Panel; }

void panel_close(Panel *panel) { delete panel; }

uint64_t panel_now(const Panel *panel) { return panel->now(); }

void panel_set(Panel *panel, uint32_t pin, uint64_t tick, uint32_t level) { panel->set(Pin(pin), tick, level); }

void panel_run(Panel *panel, uint64_t tick) { panel->run(tick); }

void panel_exchange(Panel *panel, uint64_t select, uint64_t release, size_t size, const uint8_t *mosi, uint8_t *miso) {
    panel->exchange(select, release, size, mosi, miso);
}

void panel_wave(Panel *panel, size_t ticks, const uint8_t *levels, uint8_t *miso) { panel->wave(ticks, levels, miso); }

size_t panel_changes(const Panel *panel) { return panel->ticks.size(); }

size_t panel_foci(const Panel *panel) { return panel->focus_ticks.size(); }

size_t panel_line_changes(const Panel *panel, uint32_t line) { return panel->changes[line].size(); }

void panel_take_line(Panel *panel, uint32_t line, uint64_t *ticks) { move_to(ticks, panel->changes[line]); }

void panel_take(Panel *panel, uint64_t *ticks, uint32_t *words, uint8_t *levels, uint64_t *focus_ticks) {
    move_to(ticks, panel->ticks);
    move_to(words, panel->words);
    move_to(levels, panel->levels);
    move_to(focus_ticks, panel->focus_ticks);
}

#if VM_TRACE
uint32_t panel_trace(Panel *panel, const char *path, double tick_ps, uint64_t from, uint64_t to, uint32_t inside) {
    return panel->trace(path, tick_ps, from, to, inside);
}

void panel_close_trace(Panel *panel) { panel->close_trace(); }
#endif

#pragma GCC visibility pop
}  // extern "C"
