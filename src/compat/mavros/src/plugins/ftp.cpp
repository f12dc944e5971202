// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/FileChecksum.h>
#include <mavros_msgs/FileClose.h>
#include <mavros_msgs/FileList.h>
#include <mavros_msgs/FileMakeDir.h>
#include <mavros_msgs/FileOpen.h>
#include <mavros_msgs/FileRead.h>
#include <mavros_msgs/FileRemove.h>
#include <mavros_msgs/FileRemoveDir.h>
#include <mavros_msgs/FileRename.h>
#include <mavros_msgs/FileTruncate.h>
#include <mavros_msgs/FileWrite.h>
#include <std_srvs/Empty.h>

#include <cerrno>

#include "plugins/plugins.h"

namespace trident::mavros {
namespace {

/// The services of files: all are refused, so that programs that look for them do not wait.
class Ftp : public Plugin {
 public:
  explicit Ftp(Hub& hub) : hub_(hub) {
    refuse<mavros_msgs::FileList>("list");
    refuse<mavros_msgs::FileOpen>("open");
    refuse<mavros_msgs::FileClose>("close");
    refuse<mavros_msgs::FileRead>("read");
    refuse<mavros_msgs::FileWrite>("write");
    refuse<mavros_msgs::FileRemove>("remove");
    refuse<mavros_msgs::FileMakeDir>("mkdir");
    refuse<mavros_msgs::FileRemoveDir>("rmdir");
    refuse<mavros_msgs::FileRename>("rename");
    refuse<mavros_msgs::FileTruncate>("truncate");
    refuse<mavros_msgs::FileChecksum>("checksum");
    hub.ros.serve<std_srvs::Empty>("ftp/reset",
                                   [](const auto&) { return std_srvs::Empty::Response(); });
  }

 private:
  template <class Service>
  void refuse(const std::string& name) {
    hub_.ros.serve<Service>("ftp/" + name, [this, name](const auto&) {
      hub_.ros.refuse("files refused", "ftp/" + name + ": files of a vehicle are not supported");
      typename Service::Response response;
      response.success = 0U;
      response.r_errno = EOPNOTSUPP;
      return response;
    });
  }

  Hub& hub_;
};

}  // namespace

std::unique_ptr<Plugin> make_ftp(Hub& hub) { return std::make_unique<Ftp>(hub); }

}  // namespace trident::mavros
