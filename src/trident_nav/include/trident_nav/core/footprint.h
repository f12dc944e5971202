// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// A footprint of a polygon's corners [m] in the base's axes, in either sense of rotation; the
/// result is counter-clockwise. Throws Error when there are fewer than three corners, when one is
/// not finite, when edges cross or touch, when the area is zero, or when the base's origin is not
/// inside: the planners and the inflation need a circle about it that is free of everything.
Footprint polygon_footprint(std::vector<Point2> points);

/// A footprint that is a circle about the base's origin [m]. Throws Error unless `radius` > 0.
Footprint circle_footprint(double radius);

/// The corners of text such as "[[0.2, 0.1], [0.2, -0.1], [-0.2, 0]]" [m], the form that
/// costmap_2d reads from its parameter `footprint`; blanks are free. Throws Error that shows the
/// text from where it cannot be read.
std::vector<Point2> parse_polygon(const std::string& text);

/// costmap_2d's `footprint_padding`: each coordinate of each corner is moved away from the base's
/// axes by `padding` [m] (a corner on an axis stays on it), and a circle's radius grows by it.
/// Throws Error as polygon_footprint() does, which a negative padding can cause.
Footprint padded_footprint(const Footprint& footprint, double padding);

/// A footprint whose edges are moved outwards by `distance` >= 0 [m]; at sharp corners a little
/// less. Where moved edges would cross, as in a narrow notch, those of the convex hull are moved.
Footprint grown_footprint(const Footprint& footprint, double distance);

/// The corners of a footprint at a pose; a circle gives a polygon of 16 corners on it, as
/// costmap_2d publishes it.
std::vector<Point2> footprint_corners(const Footprint& footprint, const Pose2& pose);

}  // namespace trident::nav
