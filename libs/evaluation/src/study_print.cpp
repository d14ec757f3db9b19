// SPDX-License-Identifier: BSD-3-Clause
#include <iomanip>
#include <sstream>

#include "study_picture.h"

namespace vmcl {
namespace {

std::string withDigits(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

/// A heading, then a line a cell: its place in the figure and a value a method.
template <class Place, class Value>
void printTable(std::ostream& out, const std::string& title, const std::string& place_title, const StudyPicture& cells,
                Place&& place, Value&& value) {
  out << '\n' << title << '\n' << std::left << std::setw(16) << place_title << std::right;
  for (const MethodSummary& row : cells.front()->rows) out << std::setw(11) << row.method;
  out << '\n';
  for (const CellSummary* cell : cells) {
    out << std::left << std::setw(16) << place(cell->cell.world) << std::right;
    for (const MethodSummary& row : cell->rows) out << std::setw(11) << value(row);
    out << '\n';
  }
}

void printAccuracy(std::ostream& out, const StudyPicture& cells) {
  const std::string where = ", no outliers, " + camerasOf(cells.front()->cell.world);
  const auto place = [](const WorldSettings& world) { return withDigits(world.noise_px, 0); };
  const auto error = [](const MethodSummary& row, double value) { return row.answered ? withDigits(value, 4) : "-"; };
  printTable(out, "Position error, RMS in m" + where, "noise [px]", cells, place,
             [&](const MethodSummary& row) { return error(row, row.distance.rms); });
  printTable(out, "Heading error, RMS in deg" + where, "noise [px]", cells, place,
             [&](const MethodSummary& row) { return error(row, row.angle.rms / degree); });
}

template <class Place>
void printSuccess(std::ostream& out, const std::string& place_title, const StudyPicture& cells, Place&& place) {
  const WorldSettings& world = cells.front()->cell.world;
  printTable(out, "Success rate, world \"" + std::string(nameOf(world.world)) + "\", " + camerasOf(world), place_title,
             cells, place, [](const MethodSummary& row) {
               return row.method == cramer_rao_name ? "-" : withDigits(double(row.successes) / row.trials, 3);
             });
}

}  // namespace

void printStudy(std::ostream& out, const StudyRun& run) {
  for (const StudyPicture& picture : picturesOf(run, Figure::accuracy)) printAccuracy(out, picture);
  for (const StudyPicture& picture : picturesOf(run, Figure::success))
    printSuccess(out, "outliers, depth", picture, [](const WorldSettings& world) {
      return withDigits(world.outlier_rate, 1) + ", " + withDigits(world.depth_rate, 1);
    });
  for (const StudyPicture& picture : picturesOf(run, Figure::tilt))
    printSuccess(out, "tilt [deg]", picture,
                 [](const WorldSettings& world) { return withDigits(world.tilt / degree, 2); });
}

}  // namespace vmcl
