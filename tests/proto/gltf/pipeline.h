#pragma once
// A glTF request from bytes to bytes, by the daemon's own steps, with options that need not stand in a query.

#include <string>

#include "proto/gltf/gltf.h"

namespace subdivd::test {

struct Outcome {
  proto::RefineRequest request;
  Count predicted = 0;
  std::string bytes;  // of the whole answer
};

// Reads, makes ready, plans, predicts, refines, writes.
Result<Outcome> refine_gltf(const std::string& body, proto::Format format, proto::Options options,
                            const proto::Limits& limits = {});
// From predicting on: for requests made in tests.
Result<Outcome> answer(proto::RefineRequest request);
// The pipeline where it must succeed: throws the error's message.
Outcome must_refine(const std::string& body, proto::Options options = {},
                    proto::Format format = proto::Format::glb);
proto::RefineRequest must_read(const std::string& body, proto::Options options = {},
                               proto::Format format = proto::Format::glb);

std::string to_pointer(const Path& path);

}  // namespace subdivd::test
