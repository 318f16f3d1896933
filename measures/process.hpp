#pragma once

namespace atlasgauge {

/// Settings of the whole process that a run relies on: closed standard streams stay closed, a file
/// that may grow no larger is an error instead of a signal, and freed memory goes back.
void prepare_process();

}  // namespace atlasgauge
