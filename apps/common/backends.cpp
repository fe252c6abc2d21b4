#include "apps/common/backends.h"

#include "apps/peers/peers.h"
#include "apps/referees/specialised_backend.h"
#include "engine/numeric/errors.h"

namespace vex {

std::vector<BackendKind> every_backend() {
  std::vector<BackendKind> kinds = all_backends();
  kinds.push_back(specialised_backend());
  return kinds;
}

BackendKind backend_named(const std::string& word, std::vector<BackendKind> more) {
  const std::string name = word == "ccd" ? "ccd-mpr" : word;
  std::vector<BackendKind> kinds = every_backend();
  for (BackendKind& kind : more) kinds.push_back(std::move(kind));
  std::string choices;
  for (BackendKind& kind : kinds) {
    if (kind.name == name) return std::move(kind);
    choices += (choices.empty() ? "" : ", ") + kind.name;
  }
  for (const PeerName& peer : kPeerNames) {
    if (peer.name == name) {
      throw UsageError("this build is without " + name + " (" + word + " for --backend) - build it with -D" +
                       std::string(peer.build_option) + "=ON");
    }
  }
  throw UsageError("not a choice (\"" + word + "\" for --backend) - there are " + choices);
}

std::string why_left_out(const BackendKind& kind, const NamedBody& a, const NamedBody& b) {
  if (kind.takes(*a.body, *b.body)) return "";
  for (const NamedBody* const one : {&a, &b}) {
    if (!kind.takes(*one->body, *one->body)) {
      return kind.name + " has no shape for " + one->source + " (" + one->kind + ")";
    }
  }
  return kind.name + " has no test of " + a.kind + " and " + b.kind;
}

}  // namespace vex
