// The top.v of a board as a shared library: its oscillator, whatever drives its pins and its UART, and a recorder.
// Every board's top has the same ports, but for those that only its own pads have. Pins are bits of a word, in the order of PORTS of
// compiled_top.py: channels 0 to 31, six inputs from 32 on, seven outputs from 38 on; bit 45 is the UART, its line in and its line out.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vtop.h"
#include "verilated.h"

double sc_time_stamp() { return 0; }  // wanted by Verilator's run time

namespace {

constexpr uint64_t NEVER = UINT64_MAX, UART = 1ull << 45, DRIVEN = 0xffffffff | 0x7full << 38 | UART;

class Board {
public:
    Board(uint64_t pulled_up, uint64_t half_ps) : top_{&context_}, pulled_up_{pulled_up}, half_ps_{half_ps}, edge_{half_ps} {
        context_.commandArgs(0, static_cast<const char **>(nullptr));
        eval();
    }
    ~Board() { top_.final(); }

    uint64_t now() const { return now_; }
    uint64_t outputs() const {
        const uint64_t flags = top_.spi_miso | top_.configured << 1 | top_.hv_enable << 2 | top_.hv_alive << 3 | top_.focus << 4
                               | top_.fault << 5 | top_.waiting << 6 | top_.uart_tx << 7;
        return top_.channel | flags << 38;
    }
    uint64_t levels() const { return outputs() | (outside() & ~DRIVEN); }
    uint32_t leds() const { return leds_of(top_); }

    // From outside: pins of `mask` are driven to `levels`, all others left to their pulls
    void drive(uint64_t mask, uint64_t levels) {
        mask_ = mask;
        levels_ = levels;
        eval();
    }

    // Or it stops, and with it the PLL
    void oscillate(bool runs) {
        oscillates_ = runs;
        edge_ = now_ + half_ps_;
    }

    // A fault of the PLL, from now on (pll_model.v)
    void pll(const char *fault) { context_.commandArgsAdd(1, &fault); }

    void run(uint64_t until) {
        while (now_ < until) {
            now_ = std::min({until, oscillates_ ? edge_ : NEVER, top_.eventsPending() ? top_.nextTimeSlot() : NEVER});
            context_.time(now_);
            if (oscillates_ && now_ == edge_) {
                oscillator(top_) = !oscillator(top_);
                edge_ += half_ps_;
            }
            eval();
        }
    }

    // One chip-select assertion in mode 0; MISO is sampled with the rise of SCK
    void exchange(const uint64_t *pins, uint64_t lead, uint64_t period, uint64_t lag, size_t size, const uint8_t *mosi, uint8_t *miso) {
        const uint64_t sck = pins[0], select = pins[1], out = pins[2], in = pins[3], mask = mask_ | sck | select | out;
        uint64_t others = levels_ & ~(sck | select | out), begin = now_ + lead;
        std::fill_n(miso, size, uint8_t{0});
        drive(mask, others);
        for (uint64_t bit = 0; bit < 8 * size; ++bit) {
            const uint64_t level = mosi[bit / 8] >> (7 - bit % 8) & 1 ? out : 0;
            drive(mask, others | level);
            run(begin + bit * period);
            miso[bit / 8] |= (levels() & in ? 1 : 0) << (7 - bit % 8);
            drive(mask, others | level | sck);
            run(begin + bit * period + period / 2);
        }
        drive(mask, others);
        run(now_ + lag);
        drive(mask, others | select);
    }

    std::vector<uint64_t> times, words;  // of changes of what the FPGA drives

private:
    uint64_t outside() const { return (mask_ & levels_) | (~mask_ & pulled_up_); }

    void eval() {
        const uint64_t in = outside() >> 32;
        top_.spi_sck = in & 1;
        top_.spi_cs_n = in >> 1 & 1;
        top_.spi_mosi = in >> 2 & 1;
        top_.trigger = in >> 3 & 1;
        top_.run_permit = in >> 4 & 1;
        top_.temperature_ok = in >> 5 & 1;
        top_.uart_rx = in >> 13 & 1;
        top_.eval();
        if (outputs() != word_) {
            times.push_back(now_);
            words.push_back(word_ = outputs());
        }
    }

    template <class Top> static CData &oscillator(Top &top) {
        if constexpr (requires { top.clk_25mhz; }) return top.clk_25mhz;
        else return top.clk_27mhz;
    }

    template <class Top> static uint32_t leds_of(const Top &top) {
        if constexpr (requires { top.led; }) return top.led | top.wifi_gpio0 << 8;
        return 0;
    }

    VerilatedContext context_;
    Vtop top_;
    const uint64_t pulled_up_, half_ps_;
    uint64_t now_ = 0, edge_, mask_ = 0, levels_ = 0, word_ = 0;
    bool oscillates_ = true;
};

}  // namespace

extern "C" {
#pragma GCC visibility push(default)

Board *board_open(uint64_t pulled_up, uint64_t half_ps) { return new Board{pulled_up, half_ps}; }
void board_close(Board *board) { delete board; }
uint64_t board_now(const Board *board) { return board->now(); }
uint64_t board_levels(const Board *board) { return board->levels(); }
uint32_t board_leds(const Board *board) { return board->leds(); }
void board_drive(Board *board, uint64_t mask, uint64_t levels) { board->drive(mask, levels); }
void board_oscillate(Board *board, uint32_t runs) { board->oscillate(runs); }
void board_pll(Board *board, const char *fault) { board->pll(fault); }
void board_run(Board *board, uint64_t until) { board->run(until); }
size_t board_changes(const Board *board) { return board->times.size(); }

void board_exchange(Board *board, const uint64_t *pins, uint64_t lead, uint64_t period, uint64_t lag, size_t size,
                    const uint8_t *mosi, uint8_t *miso) {
    board->exchange(pins, lead, period, lag, size, mosi, miso);
}

void board_take(Board *board, uint64_t *times, uint64_t *words) {
    std::copy(board->times.begin(), board->times.end(), times);
    std::copy(board->words.begin(), board->words.end(), words);
    board->times.clear();
    board->words.clear();
}

#pragma GCC visibility pop
}  // extern "C"
