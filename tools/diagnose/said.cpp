#include "tools/diagnose/said.h"

namespace feedtwin::tools::diagnosis {

Said said_by(const Active& effect, const View& view) {
  const View own = view.unseen();
  Said said;
  effect.hypothesis->apply(own, effect.q, said.adds);
  said.seen = own.seen();
  return said;
}

bool says_the_same(const View::Seen& seen, const Alike& alike) {
  return (!seen.transmission || alike.transmission) && (!seen.ball_screw || alike.ball_screw) &&
         (!seen.axis || alike.axis) && (!seen.base || alike.base) && (!seen.on_table || alike.on_table);
}

}  // namespace feedtwin::tools::diagnosis
