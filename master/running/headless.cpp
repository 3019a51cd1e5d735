#include "master/running/headless.h"

#include "master/output/output_files.h"
#include "master/running/cluster_setup.h"
#include "master/running/headless_run.h"
#include "master/running/invitation.h"

namespace ninefold {

int runHeadless(const Options& options) {
  // What can be told at once comes before a scene is read, which may take long.
  checkGuests(options);
  checkFiles(options);
  const Listener::Keys keys = loadKeys(options);
  const Job job = makeJob(options);
  HeadlessRun run(options, job, keys);
  return run.run();
}

}  // namespace ninefold
