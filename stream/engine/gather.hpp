#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/partition.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {
namespace detail {

/// Slices of equal length, so that one slice of `record_bytes` each and the buckets for all of them
/// fit in memory.
struct Slices {
  std::uint64_t total = 0;
  std::uint64_t length = 1;

  std::size_t count() const { return static_cast<std::size_t>((total + length - 1) / length); }
  std::size_t of(std::uint64_t index) const { return static_cast<std::size_t>(index / length); }
  std::uint64_t begin(std::size_t slice) const { return slice * length; }
  std::uint64_t end(std::size_t slice) const { return std::min(total, (slice + 1) * length); }

  static Slices plan(std::uint64_t total, std::size_t record_bytes, std::uint64_t memory_bytes) {
    return {total, std::max<std::uint64_t>(1, memory_bytes / record_bytes)};
  }
};

}  // namespace detail

/// Looks up table[index] for every index, in the order of the indices, whatever that order is:
/// requests are distributed to slices of the table, answered slice by slice, and the answers
/// distributed back to slices of the output. No random access to disk, and an index that occurs
/// often costs nothing extra. Half of the memory holds a slice, the other half the buckets of the
/// two distributions; where that is too few buckets for the table, its slices are served in rounds,
/// and where it is too few for the output, the indices are cut into stretches. Indices at or past
/// the table's end give `absent`.
template <class Value>
class Gathering {
 public:
  /// At most 2^32 indices.
  Gathering(const Engine& engine, Spill<Value>& table, const Value& absent)
      : engine_(engine), table_(table), absent_(absent), output_(engine.scratch) {
    const std::uint64_t least = 16 * engine.block_bytes();
    const std::uint64_t useful = table.size() * sizeof(Value) * 2 + least;
    memory_ = engine.budget.reserve_between(least, useful, "looking records up by index");
    slice_records_ = std::max<std::uint64_t>(1, memory_.bytes() / 2 / sizeof(Value));
    const std::uint64_t bucket_bytes =
        std::max(Partition<Request>::memory_bytes(1, 1, engine.block_bytes()),
                 Partition<Answer>::memory_bytes(1, 1, engine.block_bytes()));
    buckets_ = std::max<std::uint64_t>(2, memory_.bytes() / 4 / bucket_bytes);
  }

  Spill<Value> run(Spill<std::uint32_t> indices) {
    if (table_.size() <= slice_records_) {
      look_up(std::move(indices));
    } else {
      SpillReader<std::uint32_t> reader(indices, kConsume<std::uint32_t>);
      for (std::uint64_t left = indices.size(); left > 0;) {
        const std::uint64_t stretch = std::min(left, buckets_ * slice_records_);
        gather_stretch(reader, stretch);
        left -= stretch;
      }
    }
    return output_.finish();
  }

 private:
  struct Request {
    std::uint32_t index, at;  ///< `at` counts from the start of the stretch
  };
  struct Answer {
    std::uint32_t at;
    Value value;
  };
  template <class T>
  static constexpr auto kConsume = SpillReader<T>::Mode::kConsume;

  /// The table fits in memory.
  void look_up(Spill<std::uint32_t> indices) {
    std::vector<Value> all(table_.size());
    SpillReader<Value>(table_).read(all);
    SpillReader<std::uint32_t> reader(indices, kConsume<std::uint32_t>);
    std::uint32_t index = 0;
    while (reader.read(index)) output_.push(index < all.size() ? all[index] : absent_);
  }

  void gather_stretch(SpillReader<std::uint32_t>& indices, std::uint64_t stretch) {
    const detail::Slices outputs{stretch, slice_records_};
    Partition<Answer> answers(engine_.scratch, outputs.count());
    typename Partition<Answer>::Writer writer(answers);
    Spill<Request> requests = numbered(indices, stretch);
    SpillReader<Value> table(table_);
    for (std::uint64_t first = 0; first < table_.size(); first += buckets_ * slice_records_) {
      const std::uint64_t end = std::min(table_.size(), first + buckets_ * slice_records_);
      requests = answer_round(std::move(requests), first, end, table, outputs, writer);
    }
    SpillReader<Request> past_end(requests, kConsume<Request>);
    Request request{};
    while (past_end.read(request)) writer.push(outputs.of(request.at), {request.at, absent_});
    writer.flush();
    scatter(answers.finish(), outputs);
  }

  Spill<Request> numbered(SpillReader<std::uint32_t>& indices, std::uint64_t count) {
    SpillWriter<Request> requests(engine_.scratch);
    std::uint32_t index = 0;
    for (std::uint32_t at = 0; at < count && indices.read(index); ++at) requests.push({index, at});
    return requests.finish();
  }

  /// Answers the requests for records [first, end) of the table; returns the others.
  Spill<Request> answer_round(Spill<Request> requests, std::uint64_t first, std::uint64_t end,
                              SpillReader<Value>& table, const detail::Slices& outputs,
                              typename Partition<Answer>::Writer& writer) {
    const detail::Slices slices{end - first, slice_records_};
    SpillWriter<Request> others(engine_.scratch);
    Partition<Request> partition(engine_.scratch, slices.count());
    {
      typename Partition<Request>::Writer in_round(partition);
      SpillReader<Request> reader(requests, kConsume<Request>);
      Request request{};
      while (reader.read(request)) {
        if (request.index < first || request.index >= end) {
          others.push(request);
        } else {
          in_round.push(slices.of(request.index - first), request);
        }
      }
      in_round.flush();
    }
    std::vector<Spill<Request>> by_slice = partition.finish();
    std::vector<Value> slice;
    for (std::size_t i = 0; i < by_slice.size(); ++i) {
      slice.resize(slices.end(i) - slices.begin(i));
      table.read(slice);
      SpillReader<Request> reader(by_slice[i], kConsume<Request>);
      Request request{};
      while (reader.read(request)) {
        const Value& value = slice[request.index - first - slices.begin(i)];
        writer.push(outputs.of(request.at), {request.at, value});
      }
    }
    return others.finish();
  }

  void scatter(std::vector<Spill<Answer>> answers, const detail::Slices& outputs) {
    std::vector<Value> slice;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      slice.resize(outputs.end(i) - outputs.begin(i));
      SpillReader<Answer> reader(answers[i], kConsume<Answer>);
      Answer answer{};
      while (reader.read(answer)) slice[answer.at - outputs.begin(i)] = answer.value;
      output_.append(slice);
    }
  }

  const Engine& engine_;
  Spill<Value>& table_;
  Value absent_;
  Reservation memory_;
  std::uint64_t slice_records_ = 1;
  std::uint64_t buckets_ = 2;
  SpillWriter<Value> output_;
};

/// One Gathering. Consumes `indices`.
template <class Value>
Spill<Value> gather(const Engine& engine, Spill<std::uint32_t> indices, Spill<Value>& table,
                    const Value& absent) {
  return Gathering<Value>(engine, table, absent).run(std::move(indices));
}

}  // namespace atlasgauge
