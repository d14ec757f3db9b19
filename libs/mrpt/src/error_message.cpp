// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/mrpt/error_message.h"

#include <mrpt/core/exceptions.h>

#include <algorithm>

namespace vmcl {

std::string errorMessage(const std::exception& error) {
  try {
    std::rethrow_if_nested(error);
  } catch (const std::exception& cause) {
    return errorMessage(cause);
  }
  const auto* from_mrpt = dynamic_cast<const mrpt::ExceptionWithCallBackBase*>(&error);
  std::string message = from_mrpt ? from_mrpt->originalWhat : error.what();
  // MRPT's form is "file:line: [function] message".
  if (const auto function = message.find(": ["); from_mrpt && function != std::string::npos)
    if (const auto end = message.find("] ", function); end != std::string::npos) message.erase(0, end + 2);
  while (!message.empty() && message.back() == '\n') message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

}  // namespace vmcl
