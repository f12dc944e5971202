// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "transport/line_endpoint.h"
#include "transport/line_settings.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

// Nothing wakes a poll when somebody opens the far end.
constexpr double kLook_s = 0.05;

Descriptor open_far_end(const std::string& path) {
  return Descriptor(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
}

// Where a symbolic link leads; empty: it is no link.
std::string link_target(const std::string& link) {
  std::array<char, PATH_MAX> target;
  const auto size = readlink(link.c_str(), target.data(), target.size());
  return size > 0 ? std::string(target.data(), static_cast<std::size_t>(size)) : std::string();
}

}  // namespace

PtyEndpoint::PtyEndpoint(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
                         EndpointEvents events)
    : LineEndpoint(options, url.baud.value_or(options.default_baud), loop, std::move(events)),
      link_(url.device),
      look_(loop) {
  name_ = "pty " + link_;
  open();
  make_link();
  report_notice("leads to " + far_end_);
  look_.start(0.0, [this] { look_for_peer(); });
}

PtyEndpoint::~PtyEndpoint() {
  detach();
  if (link_target(link_) == far_end_) unlink(link_.c_str());
}

void PtyEndpoint::open() {
  terminal_ = Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  std::array<char, PATH_MAX> name;
  if (!terminal_.is_open() || grantpt(terminal_.get()) != 0 || unlockpt(terminal_.get()) != 0 ||
      ptsname_r(terminal_.get(), name.data(), name.size()) != 0) {
    throw Error("url '" + options_.url + "': pseudo-terminal: " + std::strerror(errno));
  }
  far_end_ = name.data();
  // Opened and closed once, it is hung up until somebody opens it.
  const Descriptor far_end = open_far_end(far_end_);
  if (!far_end.is_open() || !set_up_line(far_end.get(), {})) {
    throw Error("url '" + options_.url + "': " + far_end_ + ": " + std::strerror(errno));
  }
}

void PtyEndpoint::make_link() {
  // A link that an earlier run has left is replaced; anything else stays.
  if (starts_with(link_target(link_), "/dev/pts/")) unlink(link_.c_str());
  if (symlink(far_end_.c_str(), link_.c_str()) != 0) {
    throw Error("url '" + options_.url + "': link " + link_ + ": " + std::strerror(errno));
  }
}

void PtyEndpoint::look_for_peer() {
  pollfd state{terminal_.get(), POLLIN, 0};
  poll(&state, 1, 0);
  // Bytes, if it has been opened and closed in between.
  const bool is_there = (state.revents & POLLHUP) == 0 || (state.revents & POLLIN) != 0;
  if (is_there) {
    attach(terminal_.get(), link_);
  } else {
    look_.start(kLook_s, [this] { look_for_peer(); });
  }
}

// What the reader has not taken is not for the next one.
void PtyEndpoint::line_ended() {
  const Descriptor far_end = open_far_end(far_end_);
  if (far_end.is_open()) flush_line(far_end.get());
  look_.start(kLook_s, [this] { look_for_peer(); });
}

}  // namespace trident::bridges
