#include "common/gi/eye/task.h"

#include "common/gi/light/media_around.h"

namespace ninefold {

View viewOf(const Transport& t, const Settings& s) {
  View view{s.camera, s.width, s.height, {}};
  view.camera.eye = t.tracer.clearOf(s.camera.eye, s.camera.forward);
  if (!isOrthographic(s.camera)) view.eyeMedia = mediaAround(t, view.camera.eye);
  return view;
}

}  // namespace ninefold
