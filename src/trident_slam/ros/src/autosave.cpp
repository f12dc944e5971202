// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/autosave.h"

#include <cmath>
#include <string>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {

Autosave::Autosave(std::string file, double interval, Snapshot snapshot, OnProblem on_problem)
    : file_(std::move(file)),
      interval_(interval),
      snapshot_(std::move(snapshot)),
      on_problem_(std::move(on_problem)) {}

void Autosave::before_scan(const ros::Time& stamp) {
  if (!is_on() || !task_.is_busy()) return;
  if (std::abs((stamp - safe_until_).toSec()) <= interval_) return;
  task_.wait();
  on_problem_("a scan had to wait for the autosave; parameter autosave_interval (" +
              number_text(interval_) + " s) is too short");
}

// Begun every half interval: until a session is on the disk, the one before it counts.
void Autosave::after_scan(const ros::Time& stamp) {
  if (!is_on()) return;
  last_scan_ = stamp;
  if (last_saved_.isZero()) {
    safe_until_ = stamp - ros::Duration(0, stamp.isZero() ? 0 : 1);  // not even the first scan is
    save(stamp);
  }
  if (task_.is_busy()) return;
  safe_until_ = last_saved_;
  if (std::abs((stamp - last_saved_).toSec()) >= 0.5 * interval_) save(stamp);
}

void Autosave::finish() {
  if (is_on() && last_scan_ != last_saved_) save(last_scan_);
  task_.wait();
}

void Autosave::save(const ros::Time& stamp) {
  last_saved_ = stamp;
  try {
    task_.start([this, write = snapshot_()] {
      try {
        write(file_);
      } catch (const Error& error) {
        on_problem_(std::string("autosave: ") + error.what());
      }
    });
  } catch (const Error& error) {
    on_problem_(std::string("autosave: ") + error.what());
  }
}

}  // namespace trident::slam
