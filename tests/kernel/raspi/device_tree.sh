#!/bin/sh
# Debian's device tree of a Pi 4 for QEMU's raspi4b: with SPI0, its chip selects and spidev, as on Raspberry Pi OS.
# usage: device_tree.sh bcm2711-rpi-4-b.dtb OUT
set -eu
cp "$1" "$2"
tree=$2
spi=/soc/spi@7e204000
for node in $(fdtget -l "$tree" /soc); do # QEMU has none of these; the kernel would stop at the first
  case $node in
    interrupt-controller@7ef* | hdmi* | hvs* | pixelvalve* | dsi* | csi* | dpi* | vec* | txp* | avs-monitor* | v3d* | gpu* | i2c@7ef* | clock@7ef* | usb@*)
      fdtput -t s "$tree" "/soc/$node" status disabled ;;
  esac
done
for node in $(fdtget -l "$tree" /scb); do fdtput -t s "$tree" "/scb/$node" status disabled; done
gpio=$(fdtget -t x "$tree" /soc/gpio@7e200000 phandle)
fdtput -t s "$tree" $spi status okay
fdtput -t x "$tree" $spi cs-gpios "$gpio" 8 1 "$gpio" 7 1
fdtput -c "$tree" $spi/spidev@0
fdtput -t s "$tree" $spi/spidev@0 compatible rohm,dh2228fv # mainline refuses the bare "spidev"
fdtput -t x "$tree" $spi/spidev@0 reg 0
fdtput -t i "$tree" $spi/spidev@0 spi-max-frequency 125000000
# SPI0 from a fixed clock: a Pi 4's core clock while it is held at 500 MHz (QEMU's own clocks say 562.5 MHz)
fdtput -c "$tree" /spi-clock
fdtput -t s "$tree" /spi-clock compatible fixed-clock
fdtput -t x "$tree" /spi-clock '#clock-cells' 0
fdtput -t i "$tree" /spi-clock clock-frequency 500000000
fdtput -t x "$tree" /spi-clock phandle 7f00
fdtput -t x "$tree" $spi clocks 7f00
