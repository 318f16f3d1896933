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
/// distributed back to slices of the output. Two sequential passes, no random access to disk, and
/// an index that occurs often costs nothing extra. Indices at or past the table's end give
/// `absent`.
template <class Value>
class Gathering {
 public:
  /// At most 2^32 indices.
  Gathering(const Engine& engine, Spill<Value>& table, const Value& absent)
      : engine_(engine), table_(table), absent_(absent) {
    const std::uint64_t least = 16 * engine.block_bytes();
    const std::uint64_t useful = table.size() * sizeof(Value) * 2 + least;
    memory_ = engine.budget.reserve_between(least, useful, "looking records up by index");
    slices_ = detail::Slices::plan(table.size(), sizeof(Value), memory_.bytes() / 2);
  }

  Spill<Value> run(Spill<std::uint32_t> indices) {
    if (slices_.count() <= 1) return look_up(std::move(indices));
    const auto outputs = detail::Slices::plan(indices.size(), sizeof(Value), memory_.bytes() / 2);
    return scatter(answer(request(std::move(indices)), outputs), outputs);
  }

 private:
  struct Request {
    std::uint32_t index, at;
  };
  struct Answer {
    std::uint32_t at;
    Value value;
  };
  template <class T>
  static constexpr auto kConsume = SpillReader<T>::Mode::kConsume;

  /// The table fits in memory.
  Spill<Value> look_up(Spill<std::uint32_t> indices) {
    std::vector<Value> all(table_.size());
    SpillReader<Value>(table_).read(all);
    SpillWriter<Value> output(engine_.scratch);
    SpillReader<std::uint32_t> reader(indices, kConsume<std::uint32_t>);
    std::uint32_t index = 0;
    while (reader.read(index)) output.push(index < all.size() ? all[index] : absent_);
    return output.finish();
  }

  /// Requests by slice of the table; one more bucket for those past its end.
  std::vector<Spill<Request>> request(Spill<std::uint32_t> indices) {
    Partition<Request> partition(engine_.scratch, slices_.count() + 1);
    typename Partition<Request>::Writer writer(partition);
    SpillReader<std::uint32_t> reader(indices, kConsume<std::uint32_t>);
    std::uint32_t index = 0;
    for (std::uint32_t at = 0; reader.read(index); ++at) {
      writer.push(index < table_.size() ? slices_.of(index) : slices_.count(), {index, at});
    }
    writer.flush();
    return partition.finish();
  }

  /// Answers by slice of the output.
  std::vector<Spill<Answer>> answer(std::vector<Spill<Request>> requests,
                                    const detail::Slices& outputs) {
    Partition<Answer> partition(engine_.scratch, outputs.count());
    typename Partition<Answer>::Writer writer(partition);
    SpillReader<Value> table(table_);
    std::vector<Value> slice;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const bool past_end = i == slices_.count();
      slice.resize(past_end ? 0 : slices_.end(i) - slices_.begin(i));
      table.read(slice);
      SpillReader<Request> reader(requests[i], kConsume<Request>);
      Request request{};
      while (reader.read(request)) {
        const Value& value = past_end ? absent_ : slice[request.index - slices_.begin(i)];
        writer.push(outputs.of(request.at), {request.at, value});
      }
    }
    writer.flush();
    return partition.finish();
  }

  Spill<Value> scatter(std::vector<Spill<Answer>> answers, const detail::Slices& outputs) {
    SpillWriter<Value> output(engine_.scratch);
    std::vector<Value> slice;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      slice.resize(outputs.end(i) - outputs.begin(i));
      SpillReader<Answer> reader(answers[i], kConsume<Answer>);
      Answer answer{};
      while (reader.read(answer)) slice[answer.at - outputs.begin(i)] = answer.value;
      output.append(slice);
    }
    return output.finish();
  }

  const Engine& engine_;
  Spill<Value>& table_;
  Value absent_;
  Reservation memory_;
  detail::Slices slices_;
};

/// One Gathering. Consumes `indices`.
template <class Value>
Spill<Value> gather(const Engine& engine, Spill<std::uint32_t> indices, Spill<Value>& table,
                    const Value& absent) {
  return Gathering<Value>(engine, table, absent).run(std::move(indices));
}

}  // namespace atlasgauge
