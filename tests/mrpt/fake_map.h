// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/poses/CPose3D.h>

#include <functional>

#include "vmcl/geometry/planar_pose.h"

namespace vmcl {

/// A metric map with any log likelihood one likes, the same for every observation. It can use comments only.
class FakeMap : public mrpt::maps::CMetricMap {
 public:
  explicit FakeMap(std::function<double(const PlanarPose&)> log_likelihood) : likelihood_(std::move(log_likelihood)) {}

  bool isEmpty() const override { return false; }
  std::string asString() const override { return "FakeMap"; }
  void saveMetricMapRepresentationToFile(const std::string&) const override {}
  void getVisualizationInto(mrpt::opengl::CSetOfObjects&) const override {}
  mrpt::rtti::CObject* clone() const override { return new FakeMap(*this); }

 private:
  void internal_clear() override {}
  bool internal_insertObservation(const mrpt::obs::CObservation&,
                                  const std::optional<const mrpt::poses::CPose3D>&) override {
    return false;
  }
  double internal_computeObservationLikelihood(const mrpt::obs::CObservation&,
                                               const mrpt::poses::CPose3D& pose) const override {
    return likelihood_({pose.x(), pose.y(), pose.yaw()});
  }
  bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& observation) const override {
    return dynamic_cast<const mrpt::obs::CObservationComment*>(&observation) != nullptr;
  }
  uint8_t serializeGetVersion() const override { return 0; }
  void serializeTo(mrpt::serialization::CArchive&) const override {}
  void serializeFrom(mrpt::serialization::CArchive&, uint8_t) override {}

  std::function<double(const PlanarPose&)> likelihood_;
};

}  // namespace vmcl
