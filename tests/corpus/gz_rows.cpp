// .gz of the formats that are read here.
#include "corpus.h"
#include "meshes/data/archives.h"
#include "writers.h"

namespace vex::tests {
namespace {

/// A frame of gzip around bytes that are not deflated, with the file's name and a comment.
std::string stored(const std::string& bytes) {
  const std::string packed = gzipped(bytes);
  std::string frame = with_byte(packed.substr(0, 10), 3, 0x18) + "body.obj" + '\0' + "by hand" + '\0';
  frame += '\x01';
  const auto size = static_cast<std::uint16_t>(bytes.size());
  put(size, Order::little, &frame);
  put(static_cast<std::uint16_t>(~size), Order::little, &frame);
  return frame + bytes + packed.substr(packed.size() - 8);
}

}  // namespace

std::vector<Row> gz_rows() {
  Rows rows(".obj.gz");
  const Solid body = box();
  const std::string text = obj_text(body);
  const std::string bytes = gzipped(text);
  for (const Writer& writer : writers()) {
    const bool is_own = writer.extension != ".gltf" && writer.extension != ".glb" && writer.extension != ".dae" &&
                        writer.extension != ".3mf";
    const std::string file = "body" + std::string(writer.extension) + ".gz";
    if (is_own) {
      rows.is(std::string(writer.name), gzipped(writer.bytes(five_prism())), five_prism()).named(file.c_str());
    } else {
      rows.refused(std::string(writer.name), gzipped(writer.bytes(five_prism()))).named(file.c_str());
    }
  }
  rows.is("an extension in capitals", bytes, body).named("BODY.OBJ.GZ");
  rows.is("two members", gzipped(text.substr(0, 50)) + gzipped(text.substr(50)), body);
  rows.is("not deflated, with a name and a comment", stored(text), body);
  rows.is("told the format", bytes, body).named("body.dat").read_as(".obj.gz");
  rows.refused("told the format, and not that it is packed", bytes, {"gz"}).named("body.dat").read_as(".obj");
  rows.refused("cut within the heading", bytes.substr(0, 5));
  rows.refused("cut within the data", bytes.substr(0, bytes.size() / 2));
  rows.refused("cut before the check sum", without_last(bytes, 8));
  rows.refused("cut within the size", without_last(bytes, 1));
  rows.refused("a wrong check sum",
               with_byte(bytes, bytes.size() - 8, static_cast<unsigned char>(bytes[bytes.size() - 8]) ^ 1U));
  rows.refused("a wrong size",
               with_byte(bytes, bytes.size() - 4, static_cast<unsigned char>(bytes[bytes.size() - 4]) ^ 1U));
  rows.refused("a wrong bit within",
               with_byte(bytes, bytes.size() / 2, static_cast<unsigned char>(bytes[bytes.size() / 2]) ^ 16U));
  rows.refused("no archive", "Dear reader,\nthis is no mesh.\n");
  rows.refused("the text itself", text);
  rows.refused("rubbish behind the archive", bytes + "rubbish");
  rows.refused("nothing in the archive", gzipped(""));
  rows.refused("a wrong file in the archive", gzipped(replaced(text, "v 0.5 1 2", "v 1x 1 2")), {"'1x'", "line 3"});
  rows.refused("an empty file", "", {"is empty"});
  rows.refused("no format", bytes).named("body.gz");
  rows.refused("a format of no kind", bytes).named("body.tar.gz");
  rows.refused("an archive without the extension", bytes).named("body.obj");
  return rows.rows();
}

}  // namespace vex::tests
