#include "file_text.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <functional>
#include <stdexcept>

namespace vex::tests {
namespace {

std::size_t place_of(const std::string& text, std::string_view what, bool last = false) {
  const std::size_t place = last ? text.rfind(what) : text.find(what);
  if (place == std::string::npos) throw std::logic_error("the row's text holds no '" + std::string(what) + "'");
  return place;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// `change` gets every line with its number.
std::string by_lines(const std::string& text, const std::function<std::string(std::string, std::size_t)>& change) {
  std::string result;
  std::size_t number = 0;
  for (const std::string& line : lines_of(text)) result += change(line, ++number);
  return result;
}

/// By zlib; `window_bits` as its manual has it: with a frame of gzip, or with none.
std::string deflated_by_zlib(const std::string& bytes, int window_bits) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("zlib does not start");
  }
  std::string in = bytes;
  std::string out(deflateBound(&stream, static_cast<uLong>(in.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int status = deflate(&stream, Z_FINISH);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib does not end");
  return out;
}

template <class T>
void put_little(T value, std::string* bytes) {
  put(value, Order::little, bytes);
}

}  // namespace

std::string shortest(double value) {
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string printed(const char* format, double value) {
  std::array<char, 60> digits{};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(digits.data(), digits.size(), format, value);
#pragma GCC diagnostic pop
  return digits.data();
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  return text.replace(place_of(text, what), what.size(), by);
}
std::string replaced_last(std::string text, std::string_view what, std::string_view by) {
  return text.replace(place_of(text, what, true), what.size(), by);
}
std::string replaced_all(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = place_of(text, what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}
std::string without(std::string text, std::string_view what) { return replaced(std::move(text), what, ""); }
std::string up_to(const std::string& text, std::string_view what) { return text.substr(0, place_of(text, what)); }
std::string up_to_last(const std::string& text, std::string_view what) {
  return text.substr(0, place_of(text, what, true));
}
std::string without_last(std::string bytes, std::size_t n) {
  bytes.resize(bytes.size() - n);
  return bytes;
}

std::string with_line(const std::string& text, std::size_t number, std::string_view line) {
  return by_lines(
      text, [&](const std::string& old, std::size_t n) { return (n == number ? std::string(line) : old) + "\n"; });
}
std::string without_line(const std::string& text, std::size_t number) {
  return by_lines(text, [&](const std::string& old, std::size_t n) { return n == number ? "" : old + "\n"; });
}
std::string with_line_behind(const std::string& text, std::size_t number, std::string_view line) {
  const std::string added = std::string(line) + "\n";
  if (number == 0) return added + text;
  return by_lines(text, [&](const std::string& old, std::size_t n) { return old + "\n" + (n == number ? added : ""); });
}
std::string with_line_behind_every(const std::string& text, std::string_view line) {
  return by_lines(text, [&](const std::string& old, std::size_t) { return old + "\n" + std::string(line) + "\n"; });
}
std::string with_at_every_line_end(const std::string& text, std::string_view what) {
  return by_lines(text, [&](const std::string& old, std::size_t) { return old + std::string(what) + "\n"; });
}
std::string with_at_every_line_start(const std::string& text, std::string_view what) {
  return by_lines(text, [&](const std::string& old, std::size_t) { return std::string(what) + old + "\n"; });
}
std::string with_byte(std::string bytes, std::size_t at, unsigned value) {
  bytes.at(at) = static_cast<char>(static_cast<unsigned char>(value));
  return bytes;
}
std::string in_upper_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string with_crlf(const std::string& text) { return replaced_all(text, "\n", "\r\n"); }
std::string with_cr(const std::string& text) { return replaced_all(text, "\n", "\r"); }
std::string with_bom(const std::string& text) { return "\xEF\xBB\xBF" + text; }
std::string without_final_newline(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

std::string gzipped(const std::string& bytes) { return deflated_by_zlib(bytes, 15 + 16); }

std::string zipped(const std::vector<std::pair<std::string, std::string>>& files, bool deflated) {
  std::string bytes;
  std::string directory;
  for (const auto& [name, contents] : files) {
    const std::string packed = deflated ? deflated_by_zlib(contents, -15) : contents;
    std::string common;  // of the local header and of the directory's entry
    for (const int field : {20, 0, deflated ? 8 : 0, 0, 0x21}) put_little(static_cast<std::uint16_t>(field), &common);
    put_little(static_cast<std::uint32_t>(
                   crc32(0, reinterpret_cast<const Bytef*>(contents.data()), static_cast<uInt>(contents.size()))),
               &common);
    put_little(static_cast<std::uint32_t>(packed.size()), &common);
    put_little(static_cast<std::uint32_t>(contents.size()), &common);
    put_little(static_cast<std::uint16_t>(name.size()), &common);
    put_little(std::uint16_t{0}, &common);
    put_little(std::uint32_t{0x02014B50}, &directory);
    put_little(std::uint16_t{20}, &directory);
    directory += common + std::string(10, '\0');
    put_little(static_cast<std::uint32_t>(bytes.size()), &directory);
    directory += name;
    put_little(std::uint32_t{0x04034B50}, &bytes);
    bytes += common + name + packed;
  }
  std::string end;
  put_little(std::uint32_t{0x06054B50}, &end);
  put_little(std::uint32_t{0}, &end);
  put_little(static_cast<std::uint16_t>(files.size()), &end);
  put_little(static_cast<std::uint16_t>(files.size()), &end);
  put_little(static_cast<std::uint32_t>(directory.size()), &end);
  put_little(static_cast<std::uint32_t>(bytes.size()), &end);
  put_little(std::uint16_t{0}, &end);
  return bytes + directory + end;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])) : 0U;
    };
    const unsigned group = byte(0) << 16U | byte(1) << 8U | byte(2);
    result += kDigits[group >> 18U & 63U];
    result += kDigits[group >> 12U & 63U];
    result += i + 1 < bytes.size() ? kDigits[group >> 6U & 63U] : '=';
    result += i + 2 < bytes.size() ? kDigits[group & 63U] : '=';
  }
  return result;
}

std::string step_text() {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('part.stp','',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('',(0.,0.,0.));\nENDSEC;\n"
         "END-ISO-10303-21;\n";
}
std::string medit_text() {
  return "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
         "Triangles\n4\n1 3 2 0\n1 2 4 0\n2 3 4 0\n1 4 3 0\nEnd\n";
}
std::string html_text() {
  return "<!DOCTYPE html>\n<html><head><title>404 Not Found</title></head>\n<body><p>The page was not found.</p></body>"
         "</html>\n";
}

}  // namespace vex::tests
