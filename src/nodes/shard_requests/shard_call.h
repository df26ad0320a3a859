// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace vegetation_sim {

/// Whether a request may be sent again after its connection broke: it may have been carried out.
enum class Repeat { FORBIDDEN, ALLOWED };

/// How a call of another node has ended.
enum class CallResult { NOT_REACHED, BROKEN, ANSWERED };

/// Calls a service of another node, in several attempts. @param call sends the request.
/// @throws what roscpp throws.
CallResult callService(const std::string& service,
                       const std::function<bool(const std::string& service)>& call, Repeat repeat);

/// Runs `call` and then `finish` in a thread of their own, which nobody waits for. What `call`
/// throws is a broken connection. @throws InvalidInput if as many calls of this process run as may,
/// or no thread can start.
void startCall(std::function<CallResult()> call, std::function<void(CallResult)> finish);

}  // namespace vegetation_sim
