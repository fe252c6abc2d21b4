#include "archives.h"

#include "meshes/data/archives.h"

namespace vex::tests {

std::string threemf_of(const std::string& model, const std::vector<std::pair<std::string, std::string>>& more,
                       bool deflated) {
  const std::string relations =
      "<?xml version=\"1.0\"?><Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  std::vector<std::pair<std::string, std::string>> files{
      {"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}};
  files.insert(files.end(), more.begin(), more.end());
  return zipped(files, deflated);
}

}  // namespace vex::tests
