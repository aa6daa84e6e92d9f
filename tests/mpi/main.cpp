// SPDX-License-Identifier: GPL-2.0-only

#include <gtest/gtest.h>
#include <mpi.h>

namespace {

// where sanitizers do not count what Open MPI loses
class Mpi : public testing::Environment {
  void SetUp() override { MPI_Init(nullptr, nullptr); }
};

}    // namespace

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  testing::AddGlobalTestEnvironment(new Mpi);    // deleted by GoogleTest
  int failed = RUN_ALL_TESTS(), any;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return any;
}
