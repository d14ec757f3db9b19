// SPDX-License-Identifier: BSD-3-Clause
#include "vmcl/datasets/rawlog_reader.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <cstring>
#include <fstream>

#include "scratch_directory.h"

namespace vmcl {
namespace {

using namespace mrpt::obs;

std::string serialized(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << object;
  return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
}

CObservationOdometry odometry(double x) {
  CObservationOdometry observation;
  observation.sensorLabel = "odometry";
  observation.odometry.x(x);
  return observation;
}

CObservation2DRangeScan scan() {
  CObservation2DRangeScan observation;
  observation.sensorLabel = "laser";
  observation.resizeScanAndAssign(50, 2.0f, true);
  return observation;
}

class RawlogReaderTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes, const std::string& name = "log.rawlog") const {
    const auto file = scratch_.path() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  std::filesystem::path writeGz(const std::string& bytes) const {
    const auto file = scratch_.path() / "log.gz.rawlog";
    const gzFile out = gzopen(file.c_str(), "wb");
    gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(out);
    return file;
  }

  static std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static int countEntries(const std::filesystem::path& file) {
    RawlogReader reader(file);
    RawlogEntry entry;
    int count = 0;
    while (reader.next(entry)) ++count;
    return count;
  }

  static std::string failureOf(const std::filesystem::path& file) {
    try {
      countEntries(file);
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find(file.string()), 0u) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
    return "no failure";
  }

  ScratchDirectory scratch_;
};

TEST_F(RawlogReaderTest, streamsObservationsPlainAndCompressed) {
  const std::string bytes = serialized(odometry(1)) + serialized(scan()) + serialized(odometry(2));
  for (const auto& file : {write(bytes), writeGz(bytes)}) {
    RawlogReader reader(file);
    RawlogEntry entry;
    ASSERT_TRUE(reader.next(entry));
    EXPECT_EQ(std::dynamic_pointer_cast<CObservationOdometry>(entry.observation)->odometry.x(), 1);
    EXPECT_FALSE(entry.action || entry.frame);
    ASSERT_TRUE(reader.next(entry));
    EXPECT_EQ(std::dynamic_pointer_cast<CObservation2DRangeScan>(entry.observation)->getScanSize(), 50u);
    ASSERT_TRUE(reader.next(entry));
    EXPECT_FALSE(reader.next(entry));
    EXPECT_FALSE(reader.next(entry));
    EXPECT_EQ(reader.progress(), 1);
  }
}

TEST_F(RawlogReaderTest, pairsActionsWithTheirFrames) {
  CActionCollection action;
  action.insert(*CActionRobotMovement2D::Create());
  CSensoryFrame frame;
  frame.insert(CObservation2DRangeScan::Create(scan()));
  const std::string pair = serialized(action) + serialized(frame);
  RawlogReader reader(write(serialized(frame) + pair + pair + serialized(action)));
  RawlogEntry entry;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(reader.next(entry));
    EXPECT_EQ(entry.action->size(), 1u);
    EXPECT_EQ(entry.frame->size(), 1u);
    EXPECT_FALSE(entry.observation);
  }
  EXPECT_FALSE(reader.next(entry));
  EXPECT_FALSE(entry.action);
}

TEST_F(RawlogReaderTest, placesOutsideImagesBesideTheLog) {
  CObservationImage camera;
  camera.image.setExternalStorage("front.jpg");
  CSensoryFrame frame;
  frame.insert(CObservationImage::Create(camera));
  RawlogReader reader(write(serialized(camera) + serialized(CActionCollection()) + serialized(frame)));
  const std::string expected = (scratch_.path() / "log_Images" / "front.jpg").string();
  RawlogEntry entry;
  ASSERT_TRUE(reader.next(entry));
  EXPECT_EQ(dynamic_cast<CObservationImage&>(*entry.observation).image.getExternalStorageFile(), expected);
  ASSERT_TRUE(reader.next(entry));
  EXPECT_EQ(entry.frame->getObservationByClass<CObservationImage>()->image.getExternalStorageFile(), expected);
}

TEST_F(RawlogReaderTest, refusesWhatIsNoRawlog) {
  EXPECT_NE(failureOf(scratch_.path() / "missing.rawlog").find("cannot be opened"), std::string::npos);
  EXPECT_NE(failureOf(scratch_.path()).find("cannot be opened"), std::string::npos);
  EXPECT_NE(failureOf(write("")).find("is empty"), std::string::npos);
  EXPECT_NE(failureOf(write("# timestamp x y\n1 2 3\n")).find("not a rawlog"), std::string::npos);
  EXPECT_NE(failureOf(write(std::string(1000, '\xff'))).find("not a rawlog"), std::string::npos);
}

TEST_F(RawlogReaderTest, namesAnUnknownClassAndItsEntry) {
  std::string stranger = serialized(odometry(1));
  stranger.replace(stranger.find("Odometry"), 8, "Telepath");
  const std::string failure = failureOf(write(serialized(scan()) + stranger));
  EXPECT_NE(failure.find("entry 1"), std::string::npos) << failure;
  EXPECT_NE(failure.find("CObservationTelepath is not known"), std::string::npos) << failure;
}

TEST_F(RawlogReaderTest, aLogCutAnywhereInsideAnEntryIsAnError) {
  const std::string first = serialized(odometry(1)), bytes = first + serialized(scan());
  for (size_t size = 1; size < bytes.size(); ++size) {
    if (size == first.size()) continue;
    const std::string failure = failureOf(write(bytes.substr(0, size)));
    EXPECT_NE(failure, "no failure") << size << " bytes";
  }
  EXPECT_EQ(countEntries(write(first)), 1);
}

TEST_F(RawlogReaderTest, aCompressedLogCutAnywhereIsAnError) {
  const std::string whole = bytesOf(writeGz(serialized(odometry(1)) + serialized(scan())));
  for (size_t size = 1; size < whole.size(); ++size)
    EXPECT_NE(failureOf(write(whole.substr(0, size))), "no failure") << size << " bytes";
}

TEST_F(RawlogReaderTest, aDamagedByteGivesAnErrorOrAnotherNumberButNothingWorse) {
  const std::string bytes = serialized(odometry(1)) + serialized(CObservationImage());
  int refused = 0;
  for (size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    refused += failureOf(write(damaged)) != "no failure";
  }
  EXPECT_GT(refused, 40);  // the two class names alone have more bytes
}

TEST_F(RawlogReaderTest, absurdItemCountsTakeNoMemory) {
  std::string frame = serialized(CSensoryFrame());
  const uint32_t count = 0xffffffff;
  std::memcpy(&frame[frame.size() - 1 - sizeof count], &count, sizeof count);
  EXPECT_NE(failureOf(write(frame)).find("claims to hold 4294967295 items"), std::string::npos);
}

TEST_F(RawlogReaderTest, endlessNestingIsRefused) {
  std::string frame = serialized(CSensoryFrame());
  const uint32_t one = 1;
  std::memcpy(&frame[frame.size() - 1 - sizeof one], &one, sizeof one);
  frame.pop_back();  // the end flag: the next frame starts inside this one
  std::string nested;
  for (int depth = 0; depth < 20000; ++depth) nested += frame;
  const std::string failure = failureOf(write(nested));
  EXPECT_NE(failure.find("nested too deeply"), std::string::npos) << failure;
}

}  // namespace
}  // namespace vmcl
