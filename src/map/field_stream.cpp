// SPDX-License-Identifier: Apache-2.0
#include "field_stream.h"

#include <algorithm>

#include "wire_fields.h"

namespace external_command {

void FieldStream::Batch::addTo(ContentDigest* digest) const {
  for (std::size_t i = 0; i < parts; ++i) {
    digest->add(first_part + i, bytes.data() + parts_begin + i * ContentDigest::kPartSize);
  }
}

bool FieldStream::next(Batch* batch) {
  const std::lock_guard<std::mutex> lock(mutex_);
  batch->index = batches_++;
  batch->position = bytes_read_ - rest_.size();
  batch->bytes.assign(rest_);
  batch->end = 0;
  batch->first_part = parts_read_;
  batch->parts_begin = rest_.size();
  rest_.clear();
  while (batch->end == 0 && !is_broken_ && bytes_read_ < file_.size()) readPart(batch);
  batch->parts = parts_read_ - batch->first_part;
  if (batch->end > 0) rest_.assign(batch->bytes, batch->end, std::string::npos);
  return !batch->bytes.empty();
}

void FieldStream::readPart(Batch* batch) {
  std::string& bytes = batch->bytes;
  const std::size_t have = bytes.size(), size = std::min(ContentDigest::kPartSize, file_.size() - bytes_read_);
  bytes.resize(have + size);
  file_.read(bytes_read_, size, &bytes[have]);
  bytes_read_ += size;
  ++parts_read_;
  findEnd(batch);
}

void FieldStream::findEnd(Batch* batch) {
  const std::string_view bytes = batch->bytes;
  const std::size_t later = file_.size() - bytes_read_;
  while (batch->end < bytes.size()) {
    const std::size_t here = bytes.size() - batch->end;
    const auto size = fieldSize(bytes.substr(batch->end));
    is_broken_ = size ? *size > here + later : here >= kMostHead || later == 0;
    if (is_broken_ || !size || *size > here) return;
    batch->end += *size;
  }
}

}  // namespace external_command
