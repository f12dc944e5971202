// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/graph_slam_2d.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "graph_mapper.h"
#include "graph_slam/map/keyframe_map.h"
#include "graph_slam/session/session_file.h"
#include "scans/start_pose.h"
#include "trident_slam/pose_graph_g2o.h"
#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {
namespace {

/// What the map of the last snapshot was made of, for the next one.
struct LiveMap {
  explicit LiveMap(double resolution) : map(resolution) {}
  std::mutex mutex;
  KeyframeMap map;
};

/// Poses that a user gives are checked against where the map is.
Eigen::AlignedBox2d extent_of(const KeyframeGraph& graph) {
  Eigen::AlignedBox2d box;
  for (int i = 0; i < graph.size(); ++i) box.extend(graph.pose(i).p);
  return box;
}

void write_session(const Session& session, const std::string& path) {
  BinaryWriter writer;
  session.save(&writer);
  write_session_file(path, writer);
}

}  // namespace

class GraphSlam2d::Impl {
 public:
  Impl(const GraphSlamOptions& options, PoseGraphSolverMaker solver)
      : options(options),
        solver(std::move(solver)),
        mapper(new_mapper()),
        live_map(std::make_shared<LiveMap>(options.resolution)) {}

  std::unique_ptr<GraphMapper> new_mapper() const {
    return std::make_unique<GraphMapper>(options, solver);
  }

  void check(int keyframe) const {
    const int size = mapper->graph().size();
    if (keyframe >= 0 && keyframe < size) return;
    throw Error("keyframe " + std::to_string(keyframe) + ", legal: 0 to " +
                std::to_string(size - 1));
  }

  GraphSlamOptions options;
  PoseGraphSolverMaker solver;
  std::unique_ptr<GraphMapper> mapper;
  std::shared_ptr<LiveMap> live_map;
};

GraphSlam2d::GraphSlam2d(const GraphSlamOptions& options, PoseGraphSolverMaker solver)
    : impl_(std::make_unique<Impl>(options, std::move(solver))) {}

GraphSlam2d::~GraphSlam2d() = default;

ScanPose2d GraphSlam2d::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  return impl_->mapper->add_scan(scan, T_odom_base);
}

void GraphSlam2d::finish() { impl_->mapper->finish(); }

std::vector<StampedPose2d> GraphSlam2d::trajectory() const { return impl_->mapper->trajectory(); }

OccupancyGrid GraphSlam2d::map() const {
  return keyframe_map(impl_->mapper->graph(), impl_->options.resolution);
}

std::vector<CalibrationEstimate> GraphSlam2d::odometry_calibration() const {
  return impl_->mapper->local().calibration().estimates();
}

void GraphSlam2d::set_uses_odometry(bool uses_odometry) {
  impl_->options.use_odometry = uses_odometry;
  impl_->mapper->local().set_uses_odometry(uses_odometry);
}

void GraphSlam2d::set_paused(bool is_paused) { impl_->mapper->set_paused(is_paused); }
bool GraphSlam2d::is_paused() const { return impl_->mapper->is_paused(); }

void GraphSlam2d::clear() {
  const bool is_paused = impl_->mapper->is_paused();
  impl_->mapper = impl_->new_mapper();
  impl_->mapper->set_paused(is_paused);
}

void GraphSlam2d::set_mode(SlamMode mode) {
  impl_->options.mode = mode;
  impl_->mapper->set_mode(mode);
}

void GraphSlam2d::save_session(const std::string& path) const {
  write_session(impl_->mapper->session(), path);
}

/// Read and checked as a whole before the present map is replaced: an error leaves that as it was.
void GraphSlam2d::load_session(const std::string& path, const std::optional<SE2>& T_map_base) {
  BinaryReader reader = read_session_file(path);
  Session session{KeyframeGraph(1, impl_->solver), {}, {}, 0.0};
  session.load(&reader);
  if (T_map_base) check_start_pose(*T_map_base, extent_of(session.graph));
  impl_->mapper->set_session(std::move(session), T_map_base);
}

void GraphSlam2d::load_session(const std::string& path, SessionStart start, const SE2& T_map_base) {
  const bool is_pose_given = start == SessionStart::kGivenPose || start == SessionStart::kLocalize;
  load_session(path, is_pose_given ? std::optional<SE2>(T_map_base) : std::nullopt);
  if (start == SessionStart::kLocalize) set_mode(SlamMode::kLocalization);
  if (start == SessionStart::kFirstNode && nodes() > 0) set_pose(impl_->mapper->graph().pose(0));
}

/// The graph is copied, its scans are shared. The map that is kept between calls is drawn under its
/// own lock, in whichever thread runs the result.
std::function<OccupancyGrid()> GraphSlam2d::map_snapshot() const {
  return [graph = impl_->mapper->graph(), live_map = impl_->live_map] {
    const std::lock_guard<std::mutex> lock(live_map->mutex);
    return live_map->map.update(graph);
  };
}

std::function<void(const std::string&)> GraphSlam2d::session_snapshot() const {
  return [session = impl_->mapper->session()](const std::string& path) {
    write_session(session, path);
  };
}

void GraphSlam2d::realign() {
  if (impl_->options.is_asynchronous) {
    impl_->mapper->backend().realign(Realign::kScans);
  } else {
    finish();
  }
}

bool GraphSlam2d::is_busy() const { return impl_->mapper->backend().is_busy(); }

void GraphSlam2d::set_pose(const SE2& T_map_base) {
  check_start_pose(T_map_base, extent_of(impl_->mapper->graph()));
  impl_->mapper->set_pose(T_map_base);
}

void GraphSlam2d::clear_localization_buffer() { impl_->mapper->local().clear_recent_scans(); }

std::optional<SE2> GraphSlam2d::relocalize(const LaserScan& scan, double min_inliers) {
  return impl_->mapper->relocalize(scan, min_inliers);
}

bool GraphSlam2d::close_loop(int older, int newer, const SE2& T_older_newer) {
  for (const int keyframe : {older, newer}) impl_->check(keyframe);
  if (older == newer) {
    throw Error("keyframe " + std::to_string(older) + " twice, legal: two different ones");
  }
  return impl_->mapper->close_loop(older, newer, T_older_newer);
}

int GraphSlam2d::nodes() const { return impl_->mapper->graph().size(); }

std::vector<int> GraphSlam2d::move_nodes(const std::map<int, SE2>& T_map_base) {
  for (const auto& [keyframe, T] : T_map_base) {
    impl_->check(keyframe);
    check_start_pose(T, extent_of(impl_->mapper->graph()));
  }
  return impl_->mapper->move_keyframes(T_map_base);
}

int GraphSlam2d::append_session(const std::string& path, const SE2& T_map_session) {
  check_start_pose(T_map_session, extent_of(impl_->mapper->graph()));
  BinaryReader reader = read_session_file(path);
  return impl_->mapper->append(&reader, T_map_session);
}

std::vector<Eigen::Vector2f> GraphSlam2d::node_points(int node) const {
  impl_->check(node);
  std::vector<Eigen::Vector2f> points;
  for (const SurfacePoint& point : impl_->mapper->graph()[node].scan->points) {
    points.push_back(point.p);
  }
  return points;
}

GraphView2d GraphSlam2d::graph_view() const {
  const KeyframeGraph& graph = impl_->mapper->graph();
  GraphView2d view;
  view.nodes.reserve(static_cast<std::size_t>(graph.size()));
  for (int i = 0; i < graph.size(); ++i) view.nodes.push_back(graph.pose(i));
  for (const GraphEdge& edge : graph.edges()) {
    view.edges.push_back({edge.from, edge.to, edge.kind != EdgeKind::kOdometry});
  }
  return view;
}

/// Keyframes are numbered among the scans that trajectory() lists.
std::vector<GraphLoop2d> GraphSlam2d::loops() const {
  const std::vector<std::size_t> scans = impl_->mapper->scans_of_keyframes();
  std::vector<GraphLoop2d> loops;
  for (const GraphEdge& edge : impl_->mapper->graph().edges()) {
    if (edge.kind == EdgeKind::kOdometry) continue;
    loops.push_back(
        {scans[edge.from], scans[edge.to], edge.T_from_to, edge.kind == EdgeKind::kLoop});
  }
  return loops;
}

int GraphSlam2d::loops_closed() const {
  const std::vector<GraphEdge>& edges = impl_->mapper->graph().edges();
  return static_cast<int>(std::count_if(edges.begin(), edges.end(), [](const GraphEdge& edge) {
    return edge.kind == EdgeKind::kLoop;
  }));
}

/// With what the poses come from: after finish() all pairs of scans, before it the graph's edges.
void GraphSlam2d::save_g2o(const std::string& path) const {
  const KeyframeGraph& graph = impl_->mapper->graph();
  PoseGraph2d poses;
  for (int i = 0; i < graph.size(); ++i) poses.add_vertex(i, graph.pose(i));
  for (const GraphEdge& edge : impl_->mapper->measured_edges()) {
    poses.add_edge({edge.from, edge.to, edge.T_from_to, edge.information});
  }
  write_g2o(poses, path);
}

TRIDENT_SLAM_2D_METHOD(graph_slam_2d, "graph_slam_2d", GraphSlam2d, GraphSlamOptions)

}  // namespace trident::slam
