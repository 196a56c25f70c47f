// boards/ulx3s/top.v as a shared library: its oscillator, whatever drives its header pins and its UART, and a recorder.
// Pins: gp[0] to gp[27] are bits 0 to 27, gn[0] to gn[27] bits 28 to 55, ftdi_txd (in) and ftdi_rxd (out) bit 56.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vtop.h"
#include "verilated.h"

double sc_time_stamp() { return 0; }  // wanted by Verilator's run time

namespace {

constexpr uint64_t OSCILLATOR_HALF_PS = 20'000;  // 25 MHz
constexpr uint64_t NEVER = UINT64_MAX, UART = 1ull << 56, HALF_HEADER = (1ull << 28) - 1;

class Board {
public:
    Board(uint64_t inputs, uint64_t pulled_up) : top_{&context_}, inputs_{inputs}, pulled_up_{pulled_up | UART} {
        context_.commandArgs(0, static_cast<const char **>(nullptr));
        eval();
    }
    ~Board() { top_.final(); }

    uint64_t now() const { return now_; }
    // By the FPGA; Verilator takes each bit of a bus of which one is driven for driven
    uint64_t driven() const { return (top_.gp__en | uint64_t{top_.gn__en} << 28 | UART) & ~inputs_; }
    uint64_t outputs() const { return (top_.gp__out | uint64_t{top_.gn__out} << 28 | (top_.ftdi_rxd ? UART : 0)) & driven(); }
    uint64_t levels() const { return outputs() | (outside() & ~driven()); }
    uint32_t leds() const { return top_.led | top_.wifi_gpio0 << 8; }

    // From outside: pins of `mask` are driven to `levels`, all others left to their pulls
    void drive(uint64_t mask, uint64_t levels) {
        mask_ = mask;
        levels_ = levels;
        eval();
    }

    // Or it stops, and with it the PLL, whose lock falls or stays; or it runs, and the PLL stops for ever under its lock
    void oscillate(bool runs, bool lock_stays) {
        const char *stays[] = {runs ? "+clk_stops" : "+lock_stays"};
        if (lock_stays) context_.commandArgsAdd(1, stays);
        oscillates_ = runs;
        edge_ = now_ + OSCILLATOR_HALF_PS;
    }

    void run(uint64_t until) {
        while (now_ < until) {
            now_ = std::min({until, oscillates_ ? edge_ : NEVER, top_.eventsPending() ? top_.nextTimeSlot() : NEVER});
            context_.time(now_);
            if (oscillates_ && now_ == edge_) {
                top_.clk_25mhz = !top_.clk_25mhz;
                edge_ += OSCILLATOR_HALF_PS;
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
        const uint64_t in = outside();
        top_.gp = in & HALF_HEADER;
        top_.gn = in >> 28 & HALF_HEADER;
        top_.ftdi_txd = in & UART ? 1 : 0;
        top_.eval();
        if (outputs() != word_) {
            times.push_back(now_);
            words.push_back(word_ = outputs());
        }
    }

    VerilatedContext context_;
    Vtop top_;
    uint64_t now_ = 0, edge_ = OSCILLATOR_HALF_PS, mask_ = 0, levels_ = 0, word_ = 0;
    const uint64_t inputs_, pulled_up_;
    bool oscillates_ = true;
};

}  // namespace

extern "C" {
#pragma GCC visibility push(default)

Board *board_open(uint64_t inputs, uint64_t pulled_up) { return new Board{inputs, pulled_up}; }
void board_close(Board *board) { delete board; }
uint64_t board_now(const Board *board) { return board->now(); }
uint64_t board_levels(const Board *board) { return board->levels(); }
uint64_t board_driven(const Board *board) { return board->driven(); }
uint32_t board_leds(const Board *board) { return board->leds(); }
void board_drive(Board *board, uint64_t mask, uint64_t levels) { board->drive(mask, levels); }
void board_oscillate(Board *board, uint32_t runs, uint32_t lock_stays) { board->oscillate(runs, lock_stays); }
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
