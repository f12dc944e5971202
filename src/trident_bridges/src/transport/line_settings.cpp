// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/line_settings.h"

// Not <termios.h>, which knows a list of rates only and declares the same names.
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace trident::bridges {

bool set_up_line(int descriptor, const LineSettings& settings) {
  termios2 line{};
  if (ioctl(descriptor, TCGETS2, &line) != 0) return false;
  line.c_iflag = 0;
  line.c_oflag = 0;
  line.c_lflag = 0;
  line.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | BOTHER << IBSHIFT;
  if (settings.parity != Parity::kNone) line.c_cflag |= PARENB;
  if (settings.parity == Parity::kOdd) line.c_cflag |= PARODD;
  if (settings.stop_bits == 2) line.c_cflag |= CSTOPB;
  if (settings.has_hardware_flow) line.c_cflag |= CRTSCTS;
  line.c_ispeed = settings.baud;
  line.c_ospeed = settings.baud;
  line.c_cc[VMIN] = 1;  // so that a read without bytes is no end of file
  line.c_cc[VTIME] = 0;
  if (ioctl(descriptor, TCSETS2, &line) != 0) return false;
  ioctl(descriptor, TCFLSH, TCIFLUSH);
  return true;
}

void flush_line(int descriptor) { ioctl(descriptor, TCFLSH, TCIOFLUSH); }

}  // namespace trident::bridges
