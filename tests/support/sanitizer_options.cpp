// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Leaks under the address sanitizer are looked for after every test and not
   at the end of the process: in MPI_Finalize() Open MPI unloads its modules
   without freeing their memory, which then looks like anybody's. What it
   loses in MPI_Init() (called when the test environments are set up) is not
   counted; what it loses later is told by the name of its libraries, or of
   asprintf(), which only it uses here. LAMMPS does not delete the object of
   a command (run, write_dump, ...) nor what a variable holds when an error is
   thrown out of it; of the latter's stack only utils::strdup is seen, which this package does not
   call.
------------------------------------------------------------------------- */

#include <gtest/gtest.h>
#include <sanitizer/lsan_interface.h>

extern "C" const char *__lsan_default_options()
{
  return "leak_check_at_exit=0:print_suppressions=0";
}

extern "C" const char *__lsan_default_suppressions()
{
  return "leak:libmpi\n"
         "leak:libopen-rte\n"
         "leak:libopen-pal\n"
         "leak:libpmix\n"
         "leak:mca_\n"
         "leak:libhwloc\n"
         "leak:libevent\n"
         "leak:vasprintf\n"
         "leak:command_creator\n"
         "leak:WriteDump::command\n"
         "leak:LAMMPS_NS::Variable\n"
         "leak:LAMMPS_NS::utils::strdup\n";
}

namespace {

class LeakCheck : public ::testing::EmptyTestEventListener {
  void OnEnvironmentsSetUpStart(const ::testing::UnitTest &) override { __lsan_disable(); }
  void OnEnvironmentsSetUpEnd(const ::testing::UnitTest &) override { __lsan_enable(); }
  void OnTestEnd(const ::testing::TestInfo &) override
  {
    EXPECT_EQ(__lsan_do_recoverable_leak_check(), 0) << "memory leaked";
  }
};

// before the printer of the results, so that it counts what this adds
const bool registered = [] {
  auto &listeners = ::testing::UnitTest::GetInstance()->listeners();
  auto *printer = listeners.Release(listeners.default_result_printer());
  listeners.Append(new LeakCheck);
  listeners.Append(printer);
  return true;
}();

}    // namespace
