#pragma once

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/zstd.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <sstream>
#include <string>

namespace atlasgauge {

template <class Compressor>
std::string compressed(const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out;
  boost::iostreams::filtering_istream filter;
  filter.push(Compressor());
  filter.push(in);
  boost::iostreams::copy(filter, out);
  return out.str();
}

inline std::string gzip(const std::string& text) {
  return compressed<boost::iostreams::gzip_compressor>(text);
}

inline std::string zstd(const std::string& text) {
  return compressed<boost::iostreams::zstd_compressor>(text);
}

}  // namespace atlasgauge
