// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Defaults of the sanitizers for the test programs. Open MPI and the
   libraries that it loads keep memory of MPI_Init() until the process ends
   and partly lose the pointers to it; these are not ours to mend.
------------------------------------------------------------------------- */

extern "C" const char *__lsan_default_suppressions()
{
  return "leak:libmpi\n"
         "leak:libopen-rte\n"
         "leak:libopen-pal\n"
         "leak:libpmix\n"
         "leak:mca_\n"
         "leak:libhwloc\n"
         "leak:libevent\n";
}

extern "C" const char *__lsan_default_options()
{
  return "print_suppressions=0";
}
