// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/autosave.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

constexpr double kInterval = 4.0;

/// A session that holds the last scan alone, and what was written and reported.
class AutosaveTest : public testing::Test {
 protected:
  Autosave make(const std::string& file, double interval) {
    return {file, interval, [this] { return snapshot(); },
            [this](const std::string& problem) {
              const std::lock_guard<std::mutex> lock(mutex_);
              problems_.push_back(problem);
            }};
  }
  Autosave::Write snapshot() {
    if (keeps_no_sessions_) throw Error("this method keeps no sessions");
    return [this, scan = scan_](const std::string& file) {
      if (disk_.valid()) disk_.wait();
      if (is_disk_full_) throw Error(file + ": no space left");
      const std::lock_guard<std::mutex> lock(mutex_);
      written_.push_back(scan);
    };
  }
  void take(Autosave& autosave, double stamp) {
    autosave.before_scan(ros::Time(stamp));
    scan_ = stamp;
    autosave.after_scan(ros::Time(stamp));
  }
  std::vector<double> written() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return written_;
  }
  std::vector<std::string> problems() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return problems_;
  }

  double scan_ = 0.0;
  bool keeps_no_sessions_ = false;
  std::atomic<bool> is_disk_full_{false};
  std::shared_future<void> disk_;  ///< writing waits for it

 private:
  std::mutex mutex_;
  std::vector<double> written_;
  std::vector<std::string> problems_;
};

TEST_F(AutosaveTest, NeedsAFileAndAnInterval) {
  Autosave without_file = make("", kInterval);
  Autosave without_interval = make("session", 0.0);
  for (Autosave* autosave : {&without_file, &without_interval}) {
    take(*autosave, 1.0);
    autosave->finish();
  }
  EXPECT_TRUE(written().empty());
}

TEST_F(AutosaveTest, SavesTheFirstScanAndTheLastOne) {
  Autosave autosave = make("session", kInterval);
  take(autosave, 10.0);
  take(autosave, 10.1);
  autosave.finish();
  EXPECT_EQ(written(), (std::vector<double>{10.0, 10.1}));
  autosave.finish();
  EXPECT_EQ(written().size(), 2u) << "nothing was new";
}

TEST_F(AutosaveTest, IsNeverFartherBehindThanTheInterval) {
  Autosave autosave = make("session", kInterval);
  take(autosave, 10.0);
  for (int i = 1; i < 500; ++i) {
    const double stamp = 10.0 + 0.1 * i;
    autosave.before_scan(ros::Time(stamp));
    const double on_disk = written().empty() ? 10.0 : written().back();
    EXPECT_LE(stamp - on_disk, kInterval + 1e-6);
    scan_ = stamp;
    autosave.after_scan(ros::Time(stamp));
  }
  autosave.finish();
  // One each half interval, where the disk is fast enough.
  EXPECT_LE(written().size(), 2u + 50u / 2u);
}

TEST_F(AutosaveTest, ScansWaitForASlowDisk) {
  std::promise<void> disk;
  disk_ = disk.get_future();
  Autosave autosave = make("session", kInterval);
  take(autosave, 10.0);
  take(autosave, 13.9);  // still within the interval
  EXPECT_TRUE(written().empty());
  std::thread release([&] { disk.set_value(); });
  autosave.before_scan(ros::Time(14.1));
  EXPECT_EQ(written(), std::vector<double>{10.0});
  release.join();
  for (const std::string& problem : problems()) {
    EXPECT_EQ(
        problem,
        "a scan had to wait for the autosave; parameter autosave_interval (4 s) is too short");
  }
}

TEST_F(AutosaveTest, ProblemsAreReportedAndTheNextSessionIsTried) {
  Autosave autosave = make("session", kInterval);
  keeps_no_sessions_ = true;
  take(autosave, 10.0);
  keeps_no_sessions_ = false;
  is_disk_full_ = true;
  take(autosave, 12.0);
  autosave.finish();
  is_disk_full_ = false;
  take(autosave, 14.0);
  autosave.finish();
  EXPECT_EQ(problems(), (std::vector<std::string>{"autosave: this method keeps no sessions",
                                                  "autosave: session: no space left"}));
  EXPECT_EQ(written(), std::vector<double>{14.0});
}

}  // namespace
}  // namespace trident::slam
