// SPDX-License-Identifier: Apache-2.0
#include "zone_keeper.h"

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "core/durable_file.h"
#include "zone_text.h"

namespace external_command {

namespace {

constexpr std::chrono::seconds kPatience(1);                 // with the disk, before a command is sent
constexpr std::chrono::milliseconds kReadPatience(500);      // the same, before a file is read
constexpr std::chrono::seconds kPeriod(1), kRetryPeriod(2);  // of writing
constexpr std::chrono::seconds kFarewell(5);                 // for the last writes
constexpr std::chrono::seconds kQuiet(1);                    // without news: the next write is the last for now
constexpr int kShareOfDisk = 20;                             // a write may take that part of the time
constexpr std::size_t kMostKept = 4;                         // zones that are swept no more and cannot be written
constexpr const char* kSlowDisk = "the disk has not answered yet";

using Text = std::shared_ptr<const std::string>;

/// @return  why it failed; empty where it did not.
template <class Job>
std::string failureIn(const Job& job) {
  try {
    job();
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

void create(const std::string& path, const std::string& head, const std::string& lines) {
  durable_file::create(path, {head, lines, zoneChecksum(head, lines)});
}

}  // namespace

struct ZoneKeeper::Kept {
  ZonePlanFile file;
  Text lines;  ///< as in the file
  CoverageProgress progress;
  std::string failure;
  bool is_dirty = false;   ///< the file does not have it all
  bool is_busy = false;    ///< it is being written
  bool is_urgent = false;  ///< it is to be written before it is due
  bool is_over = false;
  Clock::time_point noted = Clock::now();       ///< the last time that there was news
  Clock::time_point due = Clock::now();         ///< the next time that it is written
  Clock::time_point urgent_due = Clock::now();  ///< the same where it is urgent
};

struct ZoneKeeper::Draft::State {
  ZonePlanFile file;
  std::string temporary;
  Text lines;
  CoverageProgress progress;
  bool is_written = false;  ///< these with the keeper's mutex
  bool is_adopted = false;
  std::string failure = kSlowDisk;
};

ZoneKeeper::Draft::~Draft() {
  const std::lock_guard<std::mutex> lock(keeper_.mutex_);
  if (state_->is_adopted) return;
  keeper_.executor_.post([path = state_->temporary] { durable_file::remove(path); });
}

std::string ZoneKeeper::Draft::failure() const {
  const std::lock_guard<std::mutex> lock(keeper_.mutex_);
  return state_->failure;
}

ZoneKeeper::ZoneKeeper() = default;

ZoneKeeper::~ZoneKeeper() {
  bool is_done = false;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    for (const auto& [path, kept] : kept_) {
      kept->is_over = true;
      if (kept->is_dirty && !kept->is_busy) post(kept);
    }
    executor_.post([this, &is_done] {
      const std::lock_guard<std::mutex> last(mutex_);
      is_done = true;
      changed_.notify_all();
    });
    const auto isBusy = [](const auto& kept) { return kept.second->is_busy; };
    changed_.wait_for(lock, kFarewell, [&] { return is_done && std::none_of(kept_.begin(), kept_.end(), isBusy); });
  }
  executor_.stop();
}

std::unique_ptr<ZoneKeeper::Draft> ZoneKeeper::draft(const ZonePlanFile& file, const CoverageProgress& progress) {
  auto state = std::make_shared<Draft::State>(
      Draft::State{file, file.temporaryPath(), std::make_shared<std::string>(zoneLines(progress.lines)), progress});
  std::unique_ptr<Draft> draft(new Draft(this, state));
  executor_.post([this, state] {
    const std::string failure =
        failureIn([&] { create(state->temporary, zoneHead(state->file.digest(), state->progress), *state->lines); });
    const std::lock_guard<std::mutex> lock(mutex_);
    state->failure = failure;
    state->is_written = true;
    changed_.notify_all();
  });
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, kPatience, [&] { return state->is_written; });
  return draft;
}

void ZoneKeeper::adopt(const Draft& draft) {
  const std::shared_ptr<Draft::State> state = draft.state_;
  auto kept = std::make_shared<Kept>(Kept{state->file, state->lines, state->progress, ""});
  const std::lock_guard<std::mutex> lock(mutex_);
  state->is_adopted = true;
  kept->is_dirty = kept->is_busy = true;
  kept_[state->file.path()] = kept;
  executor_.post([this, kept, state] { place(kept, state); });
}

void ZoneKeeper::note(const std::string& path, const CoverageProgress& progress, bool at_once) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = kept_.find(path);
  if (found == kept_.end()) return;
  Kept& kept = *found->second;
  kept.progress.swept = progress.swept;
  kept.progress.skipped = progress.skipped;
  kept.noted = Clock::now();
  kept.is_dirty = true;
  kept.is_urgent = kept.is_urgent || at_once;
}

void ZoneKeeper::finish(const std::string& path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = kept_.find(path);
  if (found == kept_.end()) return;
  const std::shared_ptr<Kept> kept = found->second;
  kept->is_over = true;
  kept->due = Clock::now();
  if (kept->is_dirty && !kept->is_busy) post(kept);
  if (!kept->is_dirty && !kept->is_busy) kept_.erase(found);
  forgetOldest();
}

void ZoneKeeper::tick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = Clock::now();
  for (const auto& [path, kept] : kept_) {
    const bool is_quiet = kept->failure.empty() && now >= kept->noted + kQuiet;
    const bool is_due = is_quiet || now >= (kept->is_urgent ? kept->urgent_due : kept->due);
    if (kept->is_dirty && !kept->is_busy && is_due) post(kept);
  }
}

std::string ZoneKeeper::failureOf(const std::string& path) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = kept_.find(path);
  return found == kept_.end() ? "" : found->second->failure;
}

std::optional<CoverageProgress> ZoneKeeper::unwritten(const std::string& path) {
  std::unique_lock<std::mutex> lock(mutex_);
  auto found = kept_.find(path);
  if (found == kept_.end()) return std::nullopt;
  const std::shared_ptr<Kept> kept = found->second;
  if (kept->is_dirty && !kept->is_busy && kept->failure.empty()) post(kept);
  changed_.wait_for(lock, kReadPatience, [&] { return !kept->is_busy; });
  if (!kept->is_dirty && !kept->is_busy) return std::nullopt;
  return kept->progress;
}

/// With the mutex held.
void ZoneKeeper::post(const std::shared_ptr<Kept>& kept) {
  kept->is_busy = true;
  executor_.post([this, kept] { write(kept); });
}

void ZoneKeeper::write(const std::shared_ptr<Kept>& kept) {
  const Clock::time_point begin = Clock::now();
  std::string head;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = kept_.find(kept->file.path());
    if (known == kept_.end() || known->second != kept) {  // another plan has taken its place
      kept->is_busy = false;
      return;
    }
    head = zoneHead(kept->file.digest(), kept->progress);
    kept->is_dirty = kept->is_urgent = false;
  }
  const std::string temporary = kept->file.temporaryPath();
  const std::string failure = failureIn([&] {
    create(temporary, head, *kept->lines);
    durable_file::replace(kept->file.path(), temporary);
  });
  if (!failure.empty()) durable_file::remove(temporary);
  settle(kept, failure, Clock::now() - begin);
}

void ZoneKeeper::place(const std::shared_ptr<Kept>& kept, const std::shared_ptr<Draft::State>& draft) {
  const Clock::time_point begin = Clock::now();
  std::string failure;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure = draft->failure;
    const bool is_newer = kept->progress.swept != draft->progress.swept;
    kept->is_dirty = is_newer;
  }
  if (failure.empty()) failure = failureIn([&] { durable_file::replace(draft->file.path(), draft->temporary); });
  if (!failure.empty()) durable_file::remove(draft->temporary);
  settle(kept, failure, Clock::now() - begin);
}

void ZoneKeeper::settle(const std::shared_ptr<Kept>& kept, const std::string& failure, Clock::duration took) {
  const bool failed = !failure.empty();
  if (failed) logLater(LogLevel::kWarn, warnings_, "the progress of a zone is not kept: " + failure);
  const std::lock_guard<std::mutex> lock(mutex_);
  kept->failure = failure;
  kept->is_dirty = kept->is_dirty || failed;
  kept->is_busy = false;
  kept->urgent_due =
      Clock::now() + std::max<Clock::duration>(failed ? kRetryPeriod : std::chrono::seconds(0), kShareOfDisk * took);
  kept->due = std::max(Clock::now() + kPeriod, kept->urgent_due);
  if (kept->is_over && !failed) {  // not without its last words
    const auto known = kept_.find(kept->file.path());
    const bool is_known = known != kept_.end() && known->second == kept;
    if (kept->is_dirty) {
      post(kept);
    } else if (is_known) {
      kept_.erase(known);
    }
  }
  changed_.notify_all();
}

/// With the mutex held: memory is bounded also where the disk never comes back.
void ZoneKeeper::forgetOldest() {
  std::vector<std::map<std::string, std::shared_ptr<Kept>>::iterator> over;
  for (auto kept = kept_.begin(); kept != kept_.end(); ++kept) {
    if (kept->second->is_over && !kept->second->is_busy) over.push_back(kept);
  }
  if (over.size() <= kMostKept) return;
  kept_.erase(*std::min_element(over.begin(), over.end(),
                                [](const auto& a, const auto& b) { return a->second->due < b->second->due; }));
}

}  // namespace external_command
