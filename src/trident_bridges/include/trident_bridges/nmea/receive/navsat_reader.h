// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_base/config_types.h"
#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges/nmea/receive/utc_resolver.h"
#include "trident_bridges/nmea/sentences/position.h"
#include "trident_bridges/nmea/sentences/satellites.h"

namespace trident::bridges::nmea {

/// How fixes are read, under nmea_navsat_driver's names. Its errors of position are standard
/// deviations, times the HDOP.
struct NavsatParams {
  bool use_rmc = false;        ///< fixes from RMC, which has no altitude, in place of GGA
  double epe_quality0 = 1e6;   ///< no fix [m]
  double epe_quality1 = 4.0;   ///< single [m]
  double epe_quality2 = 0.1;   ///< differential [m]
  double epe_quality4 = 0.02;  ///< RTK fixed [m]
  double epe_quality5 = 4.0;   ///< RTK float [m]
  double epe_quality9 = 3.0;   ///< augmented by satellites [m]
  bool dop_scales_gst = true;  ///< multiplies errors that GST gives by the HDOP, as upstream does

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("useRMC", use_rmc, "fixes from RMC, which has no altitude, in place of GGA");
    ar.field("epe_quality0", epe_quality0, Range::positive(), "error without a fix [m]");
    ar.field("epe_quality1", epe_quality1, Range::positive(), "of a single fix [m]");
    ar.field("epe_quality2", epe_quality2, Range::positive(), "of a differential fix [m]");
    ar.field("epe_quality4", epe_quality4, Range::positive(), "of an RTK fixed fix [m]");
    ar.field("epe_quality5", epe_quality5, Range::positive(), "of an RTK float fix [m]");
    ar.field("epe_quality9", epe_quality9, Range::positive(),
             "of one with satellite corrections [m]");
    ar.field("dop_scales_gst", dop_scales_gst,
             "multiplies errors that GST gives by the HDOP, as upstream does");
  }
};

/// Reads a satellite receiver.
class NavsatReader {
 public:
  /// `sink` outlives the reader.
  NavsatReader(const NavsatParams& params, ReceiverSink& sink) : params_(params), sink_(sink) {}

  void read(const Gga& gga, const Receipt& receipt);  ///< a fix and its time
  void read(const Rmc& rmc, const Receipt& receipt);  ///< velocity; a fix where it is to be used
  void read(const Vtg& vtg, const Receipt& receipt);  ///< velocity, after a fix of GGA
  void read(const Gst& gst, const Receipt& receipt);  ///< errors of fixes to come
  void read(const Zda& zda, const Receipt& receipt);  ///< time
  void read(const Dtm& dtm, const Receipt& receipt);  ///< offsets of fixes to come from WGS 84

 private:
  void put_fix(const Rmc& rmc, const Receipt& receipt);
  void set_errors(const Gga& gga, NavsatFix* fix) const;
  double error_of(int quality) const;
  void put_place(const std::optional<double>& latitude_deg,
                 const std::optional<double>& longitude_deg, NavsatFix* fix) const;
  void put_velocity(const std::optional<double>& speed_m_s,
                    const std::optional<double>& course_deg);
  void put_time(std::optional<std::int64_t> unix_ns);

  NavsatParams params_;
  ReceiverSink& sink_;
  UtcResolver utc_;
  bool has_fix_ = false;                                           ///< the last GGA was one
  std::optional<Gst> errors_;                                      ///< of the receiver
  double offset_latitude_deg_ = 0.0, offset_longitude_deg_ = 0.0;  ///< of the datum, from WGS 84
  std::optional<std::int64_t> last_time_ns_;                       ///< that was handed on
};

}  // namespace trident::bridges::nmea
