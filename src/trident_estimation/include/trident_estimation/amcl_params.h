// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "trident_base/config_types.h"

namespace trident::estimation {

/// The models of "Probabilistic Robotics": 6.3 (beam), 6.4 (likelihood field), and the product over
/// beams of the latter.
enum class LaserModel { kBeam, kLikelihoodField, kLikelihoodFieldProb };
/// Names of the models in YAML and parameters, those of amcl.
constexpr auto enum_names(LaserModel) {
  return std::array{EnumName{LaserModel::kBeam, "beam"},
                    EnumName{LaserModel::kLikelihoodField, "likelihood_field"},
                    EnumName{LaserModel::kLikelihoodFieldProb, "likelihood_field_prob"}};
}

/// Drive, and whether alphas are read as the book has them (corrected) or as amcl always did.
enum class OdomModel { kDiff, kOmni, kDiffCorrected, kOmniCorrected };
/// Names of the models in YAML and parameters, those of amcl.
constexpr auto enum_names(OdomModel) {
  return std::array{EnumName{OdomModel::kDiff, "diff"}, EnumName{OdomModel::kOmni, "omni"},
                    EnumName{OdomModel::kDiffCorrected, "diff-corrected"},
                    EnumName{OdomModel::kOmniCorrected, "omni-corrected"}};
}

/// How a beam's range is explained (Thrun, Burgard, Fox, "Probabilistic Robotics", 6.3 and 6.4).
struct LaserModelParams {
  LaserModel laser_model_type = LaserModel::kLikelihoodField;  ///< how a range is explained
  double laser_min_range = -1.0;                               ///< [m]
  double laser_max_range = -1.0;                               ///< [m]
  int laser_max_beams = 30;                                    ///< of a scan that are used
  double laser_z_hit = 0.95;                                   ///< in [0, 1]
  double laser_z_short = 0.1;                                  ///< in [0, 1]
  double laser_z_max = 0.05;                                   ///< in [0, 1]
  double laser_z_rand = 0.05;                                  ///< in [0, 1]
  double laser_sigma_hit = 0.2;                                ///< [m]
  double laser_lambda_short = 0.1;                             ///< [1/m]
  double laser_likelihood_max_dist = 2.0;                      ///< [m]
  /// kLikelihoodFieldProb: leave out beams that most particles cannot explain.
  bool do_beamskip = false;
  double beam_skip_distance = 0.5;         ///< [m]
  double beam_skip_threshold = 0.3;        ///< in [0, 1]
  double beam_skip_error_threshold = 0.9;  ///< in [0, 1]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    const Range probability{0.0, 1.0};
    ar.field("laser_model_type", laser_model_type, "how a range is explained");
    ar.field("laser_min_range", laser_min_range, Range::at_least(-1.0),
             "nearer returns are not used; -1: the scan's own limit [m]");
    ar.field("laser_max_range", laser_max_range, Range::at_least(-1.0),
             "farther returns are not used; -1: the scan's own limit [m]");
    ar.field("laser_max_beams", laser_max_beams, Range{2.0, 100000.0}, "of a scan that are used");
    ar.field("laser_z_hit", laser_z_hit, probability, "share of beams that hit the map");
    ar.field("laser_z_short", laser_z_short, probability, "that something unmapped stops");
    ar.field("laser_z_max", laser_z_max, probability, "without a return");
    ar.field("laser_z_rand", laser_z_rand, probability, "unexplained");
    ar.field("laser_sigma_hit", laser_sigma_hit, Range::positive(), "of a hit about the map [m]");
    ar.field("laser_lambda_short", laser_lambda_short, Range::positive(), "decay of z_short [1/m]");
    ar.field("laser_likelihood_max_dist", laser_likelihood_max_dist, Range::positive(),
             "beyond which all distances to obstacles count the same [m]");
    ar.field("do_beamskip", do_beamskip,
             "likelihood_field_prob: leave out beams that most particles cannot explain");
    ar.field("beam_skip_distance", beam_skip_distance, Range::positive(),
             "within which a particle explains a beam [m]");
    ar.field("beam_skip_threshold", beam_skip_threshold, probability,
             "share of particles that must explain a beam");
    ar.field("beam_skip_error_threshold", beam_skip_error_threshold, probability,
             "when this share of the beams would be left out, none is");
  }
};

/// Odometry's errors ("Probabilistic Robotics", 5.4; omni: sideways by alpha5). Their units make
/// variances: of rotation by rotation, of rotation by translation, of translation by translation,
/// of translation by rotation, of strafing by translation. The uncorrected types take those
/// variances for standard deviations, as the original package does, for files tuned with them.
struct MotionModelParams {
  OdomModel odom_model_type = OdomModel::kDiff;  ///< drive, and how alphas are read
  double odom_alpha1 = 0.2;                      ///< rotation from rotation
  double odom_alpha2 = 0.2;                      ///< rotation from translation
  double odom_alpha3 = 0.2;                      ///< translation from translation
  double odom_alpha4 = 0.2;                      ///< translation from rotation
  double odom_alpha5 = 0.2;                      ///< strafing from translation

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("odom_model_type", odom_model_type, "drive, and how alphas are read");
    ar.field("odom_alpha1", odom_alpha1, Range::non_negative(), "rotation from rotation");
    ar.field("odom_alpha2", odom_alpha2, Range::non_negative(), "rotation from translation");
    ar.field("odom_alpha3", odom_alpha3, Range::non_negative(), "translation from translation");
    ar.field("odom_alpha4", odom_alpha4, Range::non_negative(), "translation from rotation");
    ar.field("odom_alpha5", odom_alpha5, Range::non_negative(), "strafing from translation");
  }
};

/// Everything that the filter needs, under the names of the parameters of amcl. Those from
/// `recover_by_matching` on are ours.
struct AmclParams {
  /// Between these KLD-sampling chooses the number of particles.
  int min_particles = 100;
  int max_particles = 5000;   ///< also the number after a global localization
  double kld_err = 0.01;      ///< in [0, 1]
  double kld_z = 0.99;        ///< upper quantile of the standard normal, see kld_sample_size()
  double update_min_d = 0.2;  ///< [m]
  double update_min_a = 0.52359877559829887;  ///< [rad]
  int resample_interval = 2;                  ///< updates per resampling
  double recovery_alpha_slow = 0.001;         ///< in [0, 1]
  double recovery_alpha_fast = 0.1;           ///< in [0, 1]
  bool selective_resampling = false;          ///< only where fewer than half of the particles count
  /// Look for a lost robot in the whole map, see Amcl.
  bool recover_by_matching = true;
  double recovery_agreement = 0.7;  ///< in [0, 1]
  int recovery_patience = 2;        ///< updates in a row that must disagree, see Amcl
  double max_odom_jump = 3.0;       ///< [m]
  std::uint64_t seed = 0;           ///< of all random numbers
  LaserModelParams laser;           ///< the parameters laser_*
  MotionModelParams motion;         ///< the parameters odom_*

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("min_particles", min_particles, Range{1.0, 1e6}, "");
    ar.field("max_particles", max_particles, Range{1.0, 1e6}, "");
    ar.field("kld_err", kld_err, Range{0.0, 1.0, true},
             "Kullback-Leibler distance to the true distribution that is let pass");
    ar.field("kld_z", kld_z, Range::positive(), "upper quantile of the standard normal for that");
    ar.field("update_min_d", update_min_d, Range::non_negative(), "distance between updates [m]");
    ar.field("update_min_a", update_min_a, Range::non_negative(), "turn between updates [rad]");
    ar.field("resample_interval", resample_interval, Range{1.0, 1e6}, "updates per resampling");
    ar.field("recovery_alpha_slow", recovery_alpha_slow, Range{0.0, 1.0},
             "decay of the slow mean of weights; 0: no random particles");
    ar.field("recovery_alpha_fast", recovery_alpha_fast, Range{0.0, 1.0},
             "decay of the fast mean of weights; 0: no random particles");
    ar.field("selective_resampling", selective_resampling,
             "only where fewer than half of the particles count");
    ar.field("recover_by_matching", recover_by_matching,
             "look for a lost robot in the whole map, by branch and bound over one scan");
    ar.field(
        "recovery_agreement", recovery_agreement, Range{0.0, 1.0},
        "share of beams that agree with the map, of those that do not end where it is unknown, "
        "below which the robot may be lost");
    ar.field("recovery_patience", recovery_patience, Range{1.0, 1e6},
             "updates in a row at half of that or below, before it is looked for; more of them "
             "where they nearly agree");
    ar.field("max_odom_jump", max_odom_jump, Range::positive().or_infinite(),
             "distance from one scan to the next beyond which odometry was reset [m]");
    ar.field("seed", seed, "of all random numbers");
    laser.visit(ar);
    motion.visit(ar);
  }
  /// Throws Error unless min_particles <= max_particles.
  void validate() const;
};

}  // namespace trident::estimation
