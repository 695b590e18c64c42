// tests/vtk_views/test_guarded_read.cpp: the caller survives any reader, with an error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vtkXMLPolyDataReader.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>

#include "core/error.h"
#include "core/guarded_read.h"
#include "support/folder_test.h"
#include "vtk_views/files/error_map.h"
#include "vtk_views/files/vtk_errors.h"
#include "vtk_views/files/vtp_surface.h"

namespace softscope {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string errorOf(const std::function<std::string()>& read) {
  try {
    guardedRead("some.file", 1000, read);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), StartsWith("some.file"));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    return error.what();
  }
  ADD_FAILURE() << "was read";
  return {};
}

TEST(GuardedRead, HandsOverBytesOfAnyLength) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{5} << 20})
    EXPECT_EQ(guardedRead("f", 0, [&] { return std::string(length, 'x'); }),
              std::string(length, 'x'));
}

TEST(GuardedRead, ADeathOfTheReaderIsAnInputError) {
  EXPECT_THAT(errorOf([]() -> std::string {
                raise(SIGSEGV);
                return {};
              }),
              HasSubstr("signal 11"));
  EXPECT_THAT(errorOf([]() -> std::string { std::abort(); }), HasSubstr("signal 6"));
  EXPECT_THAT(errorOf([]() -> std::string { _exit(0); }), HasSubstr("exit code 0"))
      << "an end without an answer is no success";
}

TEST(GuardedRead, AReaderThatWantsTooMuchMemoryIsAnInputError) {
  EXPECT_THAT(errorOf([]() -> std::string { throw std::bad_alloc(); }), HasSubstr("MB"));
  EXPECT_THAT(errorOf([]() -> std::string { throw std::length_error("a size"); }), HasSubstr("MB"));
}

// Under AddressSanitizer too, whose allocator ends the child in place of std::bad_alloc.
TEST(GuardedRead, MemoryBeyondTheLimitIsRefusedToTheReader) {
  errorOf([] { return std::string(std::size_t{3} << 30, 'x'); });
}

TEST(GuardedRead, ErrorsOfTheReaderComeThrough) {
  EXPECT_EQ(errorOf([]() -> std::string { throw InputError("some.file: is bad"); }),
            "some.file: is bad");
  EXPECT_THROW(guardedRead("f", 0, []() -> std::string { throw std::runtime_error("odd"); }),
               Error);
}

TEST(GuardedRead, NothingIsPrintedByTheReader) {
  testing::internal::CaptureStderr();
  guardedRead("f", 0, [] {
    std::cerr << "libodd: warning\n" << std::flush;
    return std::string();
  });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(GuardedRead, IsTheOnlyDoorToReadersOfVtk) {
  vtkNew<vtkXMLPolyDataReader> reader;
  EXPECT_THROW(updateOrThrow(*reader, "f.vtp"), Error);
  EXPECT_FALSE(insideGuardedRead());
}

class DamagedSurface : public test::FolderTest {
 protected:
  static std::string vtp(const std::string& field_type, const std::string& points) {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n<PolyData><FieldData><DataArray type=\"" +
           field_type +
           "\" Name=\"x\" NumberOfTuples=\"1\" format=\"ascii\">1</DataArray></FieldData>"
           "<Piece NumberOfPoints=\"" +
           points +
           "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"1\">\n"
           "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">"
           "0 0 0 1 0 0 0 1 0</DataArray></Points>\n<Polys><DataArray type=\"Int64\" "
           "Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" "
           "Name=\"offsets\" "
           "format=\"ascii\">3</DataArray></Polys>\n</Piece></PolyData></VTKFile>\n";
  }
};

TEST_F(DamagedSurface, OfVtkIsAnInputErrorAndNeverACrash) {
  EXPECT_EQ(readVtkSurface(write("good.vtp", vtp("Float32", "3"))).triangles.size(), 1u);
  const std::string cut =
      "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
      "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1\n";
  const std::string far =
      "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
      "0 0 0 1e34 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
  for (const std::string& file :
       {write("cut.vtk", cut), write("far.vtk", far), write("float16.vtp", vtp("Float16", "3")),
        write("huge.vtp", vtp("Float32", "1099511627776"))}) {
    SCOPED_TRACE(file);
    try {
      readVtkSurface(file);
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(file));
    }
  }
  EXPECT_THROW(parseErrorMap(vtp("Float16", "3"), "map.vtp"), InputError);
}

TEST_F(DamagedSurface, APipeIsRefusedAtOnce) {
  const std::string pipe = folder / "pipe.vtp";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(readVtkSurface(pipe), InputError);
  EXPECT_THROW(readVtkSurface(folder), InputError);
}

}  // namespace
}  // namespace softscope
