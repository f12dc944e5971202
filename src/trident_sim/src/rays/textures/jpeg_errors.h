// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>  // needs <cstdio>

namespace trident::sim {

/// What libjpeg calls on errors, as `&base`: it keeps the message and jumps back to `jump`, which
/// is set before libjpeg is called. No object with a destructor may live across that jump.
struct JpegErrors {
  JpegErrors() {
    jpeg_std_error(&base);
    base.error_exit = [](j_common_ptr info) {
      auto* const errors = reinterpret_cast<JpegErrors*>(info->err);
      (*info->err->format_message)(info, errors->message.data());
      std::longjmp(errors->jump, 1);
    };
    base.output_message = [](j_common_ptr) {};  // nothing on stderr
  }

  jpeg_error_mgr base{};  ///< first: libjpeg knows the whole by its address
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> message{};
};

}  // namespace trident::sim
