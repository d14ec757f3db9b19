// SPDX-License-Identifier: BSD-3-Clause
#include "frame_tree.h"

#include <deque>
#include <stdexcept>

namespace vmcl {

void FrameTree::add(const std::string& parent, const std::string& child, const Rigid3& parent_from_child) {
  neighbours_[parent][child] = parent_from_child;
  neighbours_[child][parent] = parent_from_child.inverse();
}

Rigid3 FrameTree::between(const std::string& a, const std::string& b) const {
  std::map<std::string, Rigid3> a_from{{a, Rigid3::Identity()}};
  std::deque<std::string> waiting{a};
  while (!waiting.empty()) {
    const std::string frame = waiting.front();
    waiting.pop_front();
    if (frame == b) return a_from.at(frame);
    const auto neighbours = neighbours_.find(frame);
    if (neighbours == neighbours_.end()) continue;
    for (const auto& [next, frame_from_next] : neighbours->second)
      if (a_from.emplace(next, a_from.at(frame) * frame_from_next).second) waiting.push_back(next);
  }
  throw std::runtime_error("no transform between " + a + " and " + b);
}

}  // namespace vmcl
