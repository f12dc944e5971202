// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trident_ros/node_params.h"
#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {

/// Which algorithm a node runs.
struct SlamMethodParams {
  std::string method;       ///< A name of register_builtin_slam_2d().
  std::string config_file;  ///< YAML; empty: the node's parameters.

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("method", method, "SLAM method, a name of docs/howto/slam.md");
    ar.field("config_file", config_file,
             "YAML file of the method; empty: private parameters of the same names");
  }
};

/// Another name of a method's parameter, that of the upstream node.
struct ParameterAlias {
  std::string name;      ///< The method's.
  std::string upstream;  ///< The node's.
};

/// A method and what it is made from.
class SlamMethod {
 public:
  /// Reads `method` (default: `usual`) and `config_file`, then the parameters of that method from
  /// the file, or without one from private parameters of the same names. An alias counts where the
  /// method's own name is not set, an earlier one before a later one. Private parameters that a
  /// file replaces are warned about. Throws Error for an unknown method.
  SlamMethod(ros_utils::NodeParams& params, const std::string& usual,
             const std::vector<ParameterAlias>& aliases = {});

  const std::string& name() const { return name_; }  ///< of the registry
  /// The configuration comes from a YAML file.
  bool has_file() const { return !file_.empty(); }
  /// Sets a parameter, of whatever source; does nothing when the method has no such parameter.
  void set(const std::string& parameter, const std::string& text);
  /// Sets a parameter that neither the file nor the node sets, as set() does.
  void set_default(const std::string& parameter, const std::string& text);
  /// A method that optimizes pose graphs uses this solver.
  void set_solver(PoseGraphSolverMaker solver) { setup_.solver = std::move(solver); }
  /// The text of a parameter, "" when it is not set.
  std::string text(const std::string& parameter) const;
  /// The parameters as the method's struct. Throws ConfigError naming source, key, value and range.
  template <class Params>
  Params params() const {
    return setup_.params<Params>();
  }

  /// Makes the algorithm, as often as it is called. It throws Error as Slam2dFactory does.
  std::function<std::unique_ptr<Slam2d>()> maker() const;

 private:
  bool has_parameter(const std::string& name) const;
  void read_params(ros_utils::NodeParams& params, const std::vector<ParameterAlias>& aliases);
  void warn_of_ignored(ros_utils::NodeParams& params,
                       const std::vector<ParameterAlias>& aliases) const;

  std::string name_, file_;
  Slam2dFactory factory_;
  Slam2dSetup setup_;
};

/// A node keeps no ranges unless it is asked to: it runs for as long as it likes, and the poses of
/// all scans are not requested. This is the default both with and without a file.
void set_node_defaults(SlamMethod& method);

}  // namespace trident::slam
