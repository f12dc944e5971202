// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges/nmea/sentences/heading.h"
#include "trident_bridges/nmea/sentences/machinery.h"
#include "trident_bridges/nmea/sentences/water.h"
#include "trident_bridges/nmea/sentences/wind.h"

namespace trident::bridges::nmea {

/// Where magnetic north is, as far as sentences have said or somebody has set it.
struct Magnetic {
  std::optional<double> variation_deg;  ///< east of true north is positive

  /// From true north; nothing while the variation is not known.
  std::optional<double> to_true_deg(double magnetic_deg) const;
};

/// Reads compasses, logs, echo sounders, wind sensors, transducers, shafts and rudders. What they
/// mark as invalid is not handed on.
class InstrumentReader {
 public:
  /// `magnetic` and `sink` outlive the reader.
  InstrumentReader(Magnetic& magnetic, ReceiverSink& sink) : magnetic_(magnetic), sink_(sink) {}

  void read(const Hdt& hdt, const Receipt& receipt);  ///< heading
  void read(const Ths& ths, const Receipt& receipt);  ///< heading
  void read(const Hdg& hdg, const Receipt& receipt);  ///< heading and variation
  void read(const Hdm& hdm, const Receipt& receipt);  ///< heading, where the variation is known
  void read(const Rot& rot, const Receipt& receipt);  ///< rate of turn
  void read(const Vhw& vhw, const Receipt& receipt);  ///< speed through the water
  void read(const Vbw& vbw, const Receipt& receipt);  ///< the same, in two axes
  void read(const Vlw& vlw, const Receipt& receipt);  ///< distances
  void read(const Dbt& dbt, const Receipt& receipt);  ///< depth
  void read(const Dpt& dpt, const Receipt& receipt);  ///< depth
  void read(const Mtw& mtw, const Receipt& receipt);  ///< temperature of the water
  void read(const Mwv& mwv, const Receipt& receipt);  ///< wind
  void read(const Mwd& mwd, const Receipt& receipt);  ///< wind, where the heading is known
  void read(const Vwr& vwr, const Receipt& receipt);  ///< apparent wind
  void read(const Vwt& vwt, const Receipt& receipt);  ///< true wind
  void read(const Xdr& xdr, const Receipt& receipt);  ///< tilt and other numbers
  void read(const Rpm& rpm, const Receipt& receipt);  ///< speed of a shaft or engine
  void read(const Rsa& rsa, const Receipt& receipt);  ///< angles of rudders

 private:
  void put_heading(const std::optional<double>& heading_deg);
  void put_wind(bool is_true, const std::optional<double>& angle_deg,
                const std::optional<double>& speed_m_s);
  void put_wind(bool is_true, const SidedWind& wind);
  void put_measurement(const Measurement& measured, Tilt* tilt);
  void put_number(std::string_view name, const std::optional<double>& value, double factor);

  Magnetic& magnetic_;
  ReceiverSink& sink_;
  std::optional<double> heading_deg_;  ///< the newest
};

}  // namespace trident::bridges::nmea
