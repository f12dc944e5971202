# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(logs
  test/logs/carmen_log_test.cpp
  test/logs/offline_run_test.cpp
  test/logs/stamp_check_test.cpp
)
target_link_libraries(trident_slam_logs_test BZip2::BZip2 ZLIB::ZLIB)
