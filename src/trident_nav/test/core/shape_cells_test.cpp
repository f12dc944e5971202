// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/shape_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "test_random.h"

namespace trident::nav {
namespace {

constexpr int kSize = 12;
const GridGeometry kGrid{kSize, kSize, 0.5, -1.0, 2.0};

/// 'x' for the cells of runs within the grid, the topmost row first.
std::vector<std::string> picture(const std::vector<CellRun>& runs, int width, int height) {
  std::vector<std::string> rows(static_cast<std::size_t>(height),
                                std::string(static_cast<std::size_t>(width), '.'));
  for (const CellRun& run : runs) {
    for (int x = run.x0; x < run.x1; ++x) {
      rows[static_cast<std::size_t>(height - 1 - run.y)][static_cast<std::size_t>(x)] = 'x';
    }
  }
  return rows;
}

TEST(ShapeCellsTest, EdgesAlongCellsDoNotReachTheNeighbors) {
  const GridGeometry grid{4, 4, 1.0, 0.0, 0.0};
  ShapeCells cells;
  EXPECT_EQ(picture(cells.polygon(grid, {{1, 1}, {3, 1}, {3, 2}, {1, 2}}), 4, 4),
            (std::vector<std::string>{"....", "....", ".xx.", "...."}));
  EXPECT_EQ(picture(cells.polygon(grid, {{1, 1}, {3.01, 1}, {3.01, 2}, {1, 2}}), 4, 4),
            (std::vector<std::string>{"....", "....", ".xxx", "...."}));
}

TEST(ShapeCellsTest, TheInsideIsIncludedAndAHollowIsNot) {
  const GridGeometry grid{7, 5, 1.0, 0.0, 0.0};
  ShapeCells cells;
  // A U whose arms are one cell wide.
  const std::vector<Point2> u{{0.1, 0.1}, {6.9, 0.1}, {6.9, 4.9}, {6.1, 4.9},
                              {6.1, 0.9}, {0.9, 0.9}, {0.9, 4.9}, {0.1, 4.9}};
  EXPECT_EQ(picture(cells.polygon(grid, u), 7, 5),
            (std::vector<std::string>{"x.....x", "x.....x", "x.....x", "x.....x", "xxxxxxx"}));
  EXPECT_EQ(picture(cells.polygon(grid, {{0.5, 0.5}, {6.5, 0.5}, {6.5, 4.5}, {0.5, 4.5}}), 7, 5),
            std::vector<std::string>(5, "xxxxxxx"));
}

bool is_inside(const std::vector<Point2>& polygon, const Point2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)) {
      inside = !inside;
    }
  }
  return inside;
}

TEST(ShapeCellsTest, NoPointOfAPolygonLiesOutsideOfItsCellsAndNoCellWithoutOne) {
  TestRandom random(11);
  ShapeCells cells;
  for (int round = 0; round < 15; ++round) {
    std::vector<Point2> star;  // may be hollow, never crosses itself
    for (int k = 0; k < 7; ++k) {
      const double r = 0.4 + 1.6 * random.uniform(), angle = 2.0 * M_PI * (k + 0.5) / 7;
      star.push_back({2.0 + r * std::cos(angle), 5.0 + r * std::sin(angle)});
    }
    const auto rows = picture(cells.polygon(kGrid, star), kSize, kSize);
    constexpr int kSamples = 40;  // along each side of a cell
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        int inside = 0;
        for (int k = 0; k < kSamples * kSamples; ++k) {
          const Point2 p{kGrid.origin_x + 0.5 * (x + (k % kSamples + 0.5) / kSamples),
                         kGrid.origin_y + 0.5 * (y + (k / kSamples + 0.5) / kSamples)};
          inside += is_inside(star, p) ? 1 : 0;
        }
        const bool is_cell =
            rows[static_cast<std::size_t>(kSize - 1 - y)][static_cast<std::size_t>(x)] == 'x';
        if (inside > 0) EXPECT_TRUE(is_cell) << round << ' ' << x << ' ' << y;
        // A sliver may pass between the samples, but then next to others' samples.
        if (inside == 0 && is_cell) {
          bool touches = false;
          for (std::size_t i = 0; i < star.size(); ++i) {
            const Point2 &a = star[i], &b = star[(i + 1) % star.size()];
            for (int s = 0; s <= 500; ++s) {
              const Cell c = kGrid.cell(a.x + (b.x - a.x) * s / 500, a.y + (b.y - a.y) * s / 500);
              touches |= c == Cell{x, y};
            }
          }
          EXPECT_TRUE(touches) << round << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

TEST(ShapeCellsTest, ADiscsCells) {
  const GridGeometry grid{5, 5, 1.0, 0.0, 0.0};
  ShapeCells cells;
  EXPECT_EQ(picture(cells.disc(grid, {2.5, 2.5}, 0.6), 5, 5),
            (std::vector<std::string>{".....", "..x..", ".xxx.", "..x..", "....."}));
  EXPECT_EQ(picture(cells.disc(grid, {2.5, 2.5}, 0.8), 5, 5),
            (std::vector<std::string>{".....", ".xxx.", ".xxx.", ".xxx.", "....."}));
}

}  // namespace
}  // namespace trident::nav
