#include "corpus.h"

namespace vex::tests {

Rows::Rows(std::string extension, std::string label)
    : extension_(std::move(extension)), label_(label.empty() ? extension_.substr(1) : std::move(label)) {}

Row& Rows::added(const std::string& name, const std::string& bytes) {
  return rows_.emplace_back(Row{.name = label_ + ": " + name, .file = "body" + extension_, .bytes = bytes});
}

Row& Rows::is(const std::string& name, const std::string& bytes, const Solid& solid) {
  Row& row = added(name, bytes);
  row.body = solid;
  return row;
}

Row& Rows::refused(const std::string& name, const std::string& bytes, std::vector<std::string> fragments) {
  Row& row = no_body(name, bytes, std::move(fragments));
  row.names_the_file = true;
  return row;
}

Row& Rows::no_body(const std::string& name, const std::string& bytes, std::vector<std::string> fragments) {
  Row& row = added(name, bytes);
  row.fragments = std::move(fragments);
  return row;
}

const std::vector<Row>& corpus() {
  static const std::vector<Row> kRows = [] {
    std::vector<Row> all;
    for (const auto& part :
         {obj_rows, obj_refusals, off_rows, ply_rows, ply_refusals, stl_rows, point_rows, vtk_rows, msh_rows, gltf_rows,
          dae_and_3mf_rows, rarer_rows, gz_rows, rounding_rows, standard_input_rows, every_format_rows}) {
      const std::vector<Row> rows = part();
      all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
  }();
  return kRows;
}

}  // namespace vex::tests
