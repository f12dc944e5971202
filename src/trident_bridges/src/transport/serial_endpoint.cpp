// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/vfs.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "transport/line_endpoint.h"
#include "transport/line_settings.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

bool is_pseudo_terminal(int descriptor) {
  struct statfs system = {};
  return fstatfs(descriptor, &system) == 0 && system.f_type == DEVPTS_SUPER_MAGIC;
}

}  // namespace

SerialEndpoint::SerialEndpoint(const EndpointOptions& options, const EndpointUrl& url,
                               PollLoop& loop, EndpointEvents events)
    : LineEndpoint(options, url.baud.value_or(options.default_baud), loop, std::move(events)),
      url_(url),
      baud_(url.baud.value_or(options.default_baud)),
      attempt_(loop) {
  name_ = "serial " + url.device + ":" + std::to_string(baud_);
  // A file that is no terminal is an error now; a device that is not there may come later.
  const std::string failure = open_device();
  if (!failure.empty() && (errno == ENOTTY || errno == EISDIR)) {
    throw Error("url '" + options_.url + "': device " + url.device + ": " + failure);
  }
  if (!failure.empty()) device_.reset();
  attempt_.start(0.0, [this] { open(); });
}

// Returns what went wrong, with errno; empty: nothing.
std::string SerialEndpoint::open_device() {
  device_ = Descriptor(::open(url_.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  LineSettings settings;
  settings.baud = baud_;
  settings.parity = options_.parity;
  settings.stop_bits = options_.stop_bits;
  settings.has_hardware_flow = url_.kind == EndpointKind::kSerialHardwareFlow;
  // Two readers of one line would each get a part of it. Other programs that lock do so like this.
  if (device_.is_open() && flock(device_.get(), LOCK_EX | LOCK_NB) != 0) {
    errno = EBUSY;
  } else if (device_.is_open() && set_up_line(device_.get(), settings)) {
    return "";
  }
  const int code = errno;
  std::string text = std::strerror(code);
  errno = code;
  return text;
}

void SerialEndpoint::open() {
  const std::string failure = device_.is_open() ? "" : open_device();
  if (!failure.empty()) {
    device_.reset();
    report_warning("open",
                   failure + "; it is tried again every " + number_text(options_.retry_s) + " s");
    attempt_.start(options_.retry_s, [this] { open(); });
    return;
  }
  if (was_open_) ++counts_.reconnects;
  was_open_ = true;
  vanished_.reset();
  forget_warning("open");
  attach(device_.get(), url_.device);
}

void SerialEndpoint::line_ended() {
  if (is_pseudo_terminal(device_.get())) {
    flock(device_.get(), LOCK_UN);
    vanished_ = std::move(device_);
  }
  device_.reset();
  attempt_.start(options_.retry_s, [this] { open(); });
}

}  // namespace trident::bridges
