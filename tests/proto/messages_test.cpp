#include "proto/messages.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "common/scene/settings_table.h"
#include "proto/edit_messages.h"
#include "proto/messages.pb.h"
#include "proto/scene_blobs.h"
#include "proto/state_wire.h"
#include "proto/tile_names.h"

namespace ninefold {
namespace {

Sha256 someHash(uint8_t fill) {
  Sha256 hash;
  hash.fill(fill);
  return hash;
}

Settings oddSettings() {
  Settings s;
  s.method = Method::pathTrace;
  s.width = 1, s.height = 16384;
  s.camera = {"küche", Vec3(1, 2, 3), Vec3(0, 0, 1), Vec3(0, 2, 0), 1.25f, 3.5f};
  s.interleave = {16, 1};
  s.directVpls = 0, s.indirectVpls = 65536, s.photons = 16777216;
  s.resampling = 3, s.cameraPoints = 4096;
  s.partition = PartitionRule::equal;
  s.mapPhotons = 4194304, s.mapPerFrame = 1, s.mapNearest = 65536, s.mapDistance = 1.5f;
  s.mapDirect = MapDirect::on, s.mapDistribution = MapDistribution::turn;
  s.mapIndex = MapIndex::tree;
  s.mapEstimate = MapEstimate::vertices, s.mapSubdivision = 6;
  s.photonPool = 4194304, s.photonGroups = 20160, s.pilotRatio = 2, s.minorLamps = 0.25f,
  s.elementSize = 1.5f;
  s.elementRule = ElementRule::buckets;
  s.fieldDirections = 76, s.fieldDistances = 127, s.fieldPhotons = 4194304;
  s.fieldDirect = FieldDirect::field, s.fieldWeights = FieldWeights::alike;
  s.maxFieldMemory = 1048576;
  s.pathLength = 4, s.specularDepth = 1;
  s.bound = 1e-3f, s.photonRadius = 0.5f, s.vplRoulette = 0.25f;
  s.caustics = Caustics::direct;
  s.environment = Vec3(1e6f, 0, 1e-6f);
  s.seed = ~0ull;
  s.randomization = Randomization::random;
  s.jitter = false;
  s.compensate = false;
  return s;
}

SceneEdit oddEdit() {
  SceneEdit edit;
  ObjectEdit object{7, DMat4(1)};
  for (int i = 0; i < 12; ++i) object.motion[i / 3][i % 3] = 0.1 * (i + 1);
  edit.objects.push_back(object);
  edit.lights.push_back({2, Vec3(1, 2, 3), Vec3(0, -1, 0), Vec3(4, 5, 6), Vec3(0, 0, 1)});
  edit.materials.push_back({3, Vec3(0.1f, 0.2f, 0.3f), 0.4f, 0.5f, 0.6f, 1.7f, Vec3(8, 9, 10)});
  const std::vector<Vec3> positions{Vec3(1, 2, 3), Vec3(-0.0f, 4, 5)};
  edit.shapes = shapeEdits(6, positions, std::vector<Vec3>(2, Vec3(0, 1, 0)));
  edit.shapes.push_back({{7, 3}, shapeEdits(7, positions, {})[0].vertices});
  return edit;
}

StatePage somePage(uint16_t kind, uint32_t index) {
  return {{kind, index}, {someHash(5), kMaxPageBlobBytes, BlobKind::page}};
}

// One message of every type, with every field different from its default.
std::vector<Message> oneOfEach() {
  return {
      msg::Hello{7, "1.2.3", "host ü/42", 64, "avx512", "0123456789abcdef", true},
      msg::Welcome{5, "1.2.3", "0123456789abcdef", 1'700'000'000'000},
      msg::Refuse{"another release"},
      msg::SceneOffer{3, {{someHash(1), 10, BlobKind::image}, {someHash(2), 20, BlobKind::rest}}},
      msg::BlobRequest{someHash(3), 1 << 20},
      msg::BlobChunk{someHash(4), 100, 103, Bytes(3, std::byte{9})},
      msg::Configure{3,
                     4,
                     oddSettings(),
                     {9, Delivery::Form::display, SurfaceTest::none, -1.5f, ToneCurve::agx}},
      msg::Ready{3, 4},
      msg::Progress{Phase::building, 2, 5},
      msg::Tasks{4,
                 {10, 11, 12, 0.25f, std::vector(kMostLightCameras, oddSettings().camera), 13},
                 {{1, 2, 3}, {4, 255, 31}},
                 0.5f,
                 true,
                 milliseconds(1500)},
      msg::Cancel{4, 10},
      msg::Result{4, 10, 1, 2, 12345, 3, 6, 7, {1, 2, 3, 4}, Bytes(100, std::byte{5})},
      msg::Ping{1},
      msg::Pong{1, 2},
      msg::Goodbye{"done"},
      msg::Edit{9, oddEdit(), true, true},
      msg::Steps{4, {21, 5, 7, 40, 3, 9}, {40, ~0u}, milliseconds(1500)},
      msg::Stepped{4, 21, 41, 12345, ~0ull, {1, 2, 3, 4}, Bytes(100, std::byte{5})},
      msg::CancelSteps{21},
      msg::StateDelta{5, 7, 2, 3, ~0ull, 4, Bytes(100, std::byte{6})},
      msg::StateOffer{7, ~0ull, {somePage(1, 9), somePage(65535, 0), somePage(65535, ~0u)}}};
}

Peer senderOf(const Message& message) {
  return maySend(Peer::client, typeOf(message)) ? Peer::client : Peer::master;
}

TEST(Messages, EveryTypeSurvivesTheRoundTrip) {
  const std::vector<Message> messages = oneOfEach();
  ASSERT_EQ(messages.size(), std::variant_size_v<Message>);
  for (const Message& message : messages) {
    const Frame sent = encodeMessage(Message(message));
    const Message received = decodeMessage(Frame(sent), senderOf(message));
    ASSERT_EQ(received.index(), message.index());
    // Every field is set: equal bytes on the second way mean equal fields.
    EXPECT_EQ(encodeMessage(Message(received)), sent) << nameOf(typeOf(message));
  }
}

TEST(Messages, FieldsArriveWhereTheyBelong) {
  const auto decode = [](Message m) {
    const Peer sender = senderOf(m);
    return decodeMessage(encodeMessage(std::move(m)), sender);
  };
  const auto result = std::get<msg::Result>(decode(oneOfEach()[11]));
  EXPECT_EQ(result.tile, 1u);
  EXPECT_EQ(result.rays.compensation, 4u);
  EXPECT_EQ(result.encoded.size(), 100u);
  const auto tasks = std::get<msg::Tasks>(decode(oneOfEach()[9]));
  EXPECT_EQ(tasks.frame.rotation, 12u);
  EXPECT_EQ(tasks.frame.lightCameras, std::vector(kMostLightCameras, oddSettings().camera));
  EXPECT_EQ(tasks.items[1], (msg::TaskItem{4, 255, 31}));
  EXPECT_EQ(tasks.frame.state, 13u);
  EXPECT_TRUE(tasks.urgent);
  EXPECT_EQ(std::get<msg::Edit>(decode(oneOfEach()[15])).edit, oddEdit());
  EXPECT_TRUE(std::get<msg::Edit>(decode(oneOfEach()[15])).moving);
  const auto steps = std::get<msg::Steps>(decode(oneOfEach()[16]));
  EXPECT_EQ(steps.step, (StepKey{21, 5, 7, 40, 3, 9}));
  EXPECT_EQ(steps.units, (std::vector<uint32_t>{40, ~0u}));
  EXPECT_EQ(steps.allowed, milliseconds(1500));
  const auto stepped = std::get<msg::Stepped>(decode(oneOfEach()[17]));
  EXPECT_EQ(stepped.unit, 41u);
  EXPECT_EQ(stepped.rays.compensation, 4u);
  EXPECT_EQ(stepped.deltas, Bytes(100, std::byte{5}));
  const auto delta = std::get<msg::StateDelta>(decode(oneOfEach()[19]));
  EXPECT_EQ(delta.part, 2u);
  EXPECT_EQ(delta.oldest, 4u);
  EXPECT_EQ(delta.deltas, Bytes(100, std::byte{6}));
  const auto offer = std::get<msg::StateOffer>(decode(oneOfEach()[20]));
  EXPECT_EQ(offer.pages, std::get<msg::StateOffer>(oneOfEach()[20]).pages);
  const auto settings = std::get<msg::Configure>(decode(oneOfEach()[6])).settings;
  EXPECT_EQ(settings.camera, oddSettings().camera);
  EXPECT_EQ(settings.interleave, oddSettings().interleave);
  EXPECT_EQ(settings.seed, ~0ull);
}

TEST(Messages, NobodySpeaksTheOthersLines) {
  for (const Message& message : oneOfEach()) {
    const MessageType type = typeOf(message);
    const bool both =
        type == MessageType::ping || type == MessageType::pong || type == MessageType::goodbye;
    EXPECT_EQ(maySend(Peer::client, type) && maySend(Peer::master, type), both) << nameOf(type);
    if (both) continue;
    const Peer wrong = senderOf(message) == Peer::client ? Peer::master : Peer::client;
    EXPECT_THROW(decodeMessage(encodeMessage(Message(message)), wrong), Error) << nameOf(type);
  }
}

// What travels for a drag is a few numbers, however large the thing is.
TEST(Messages, AnEditIsAsLongAsWhatChanged) {
  SceneEdit edit;
  const auto bytes = [&] { return encodeMessage(msg::Edit{1, edit}).header.size(); };
  for (int i = 1; i <= 50; ++i) {
    edit.objects.push_back({i, DMat4(1)});
    EXPECT_LE(bytes(), 120u * static_cast<size_t>(i) + 16);
  }
}

// The payload holds just the vertices that the header names.
TEST(Messages, AShapeHasAllItsVertices) {
  const auto refused = [](const std::function<void(Frame&)>& spoil) {
    Frame frame = encodeMessage(msg::Edit{1, oddEdit()});
    spoil(frame);
    try {
      decodeMessage(std::move(frame), Peer::master);
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refused([](Frame&) {}), "");
  EXPECT_NE(refused([](Frame& f) { f.payload.pop_back(); }).find("shape"), std::string::npos);
  EXPECT_NE(refused([](Frame& f) { f.payload.push_back({}); }).find("too many"), std::string::npos);
  // Field 6 of Edit, ShapeEdits of no vertex and of too many.
  for (const std::string& piece :
       {std::string("\x32\x02\x18\x00", 4), std::string("\x32\x04\x18\x81\x80\x01", 6)}) {
    EXPECT_NE(refused([&](Frame& f) { f.header = piece, f.payload.clear(); }), "");
  }
}

// A mesh of many pieces travels in several messages; the last one makes the scene.
TEST(Messages, ALongEditIsSeveralMessages) {
  SceneEdit edit = oddEdit();
  edit.shapes = shapeEdits(2, std::vector<Vec3>(12 * ShapePiece::kVertices + 1, Vec3(1)), {});
  const std::vector<msg::Edit> messages = editMessages(5, edit, true);
  ASSERT_EQ(messages.size(), 3u);
  SceneEdit all;
  for (size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].more, i < 2);
    EXPECT_TRUE(messages[i].moving);
    EXPECT_EQ(messages[i].version, 5u);
    const Frame frame = encodeMessage(msg::Edit(messages[i]));
    EXPECT_LE(frame.payload.size(), kMaxShapeBytes);
    merge(all, std::get<msg::Edit>(decodeMessage(Frame(frame), Peer::master)).edit);
  }
  EXPECT_EQ(all, edit);
  EXPECT_EQ(editMessages(5, {}, false).size(), 1u) << "what ends a gesture may hold nothing";
}

TEST(Messages, AMotionHasTwelveNumbers) {
  Frame frame = encodeMessage(msg::Edit{1, oddEdit()});
  // Field 2 of Edit, an ObjectEdit with node 7 and no motion.
  frame.header = std::string("\x12\x02\x08\x07", 4);
  EXPECT_THROW(decodeMessage(std::move(frame), Peer::master), Error);
}

TEST(Messages, UnknownTypesAreRefused) {
  for (const uint16_t type : {uint16_t{0}, uint16_t{22}, uint16_t{65535}}) {
    EXPECT_THROW(decodeMessage(Frame{type, "", {}}, Peer::client), Error);
    EXPECT_EQ(messageLimit(type).header + messageLimit(type).payload, 0u);
  }
}

// The error's text, "" if the message is accepted.
std::string refusal(Message message) {
  try {
    const Peer sender = senderOf(message);
    decodeMessage(encodeMessage(std::move(message)), sender);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const std::function<void(Settings&)>& spoil) {
  msg::Configure configure;
  spoil(configure.settings);
  return refusal(Message(configure));
}

TEST(Messages, SettingsOutOfRangeAreNamed) {
  EXPECT_EQ(refusal([](Settings&) {}), "");
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"width", [](Settings& s) { s.width = 0; }},
      {"width", [](Settings& s) { s.width = -5; }},
      {"height", [](Settings& s) { s.height = 16385; }},
      {"method", [](Settings& s) { s.method = static_cast<Method>(methodTable().size()); }},
      {"caustics", [](Settings& s) { s.caustics = static_cast<Caustics>(3); }},
      {"partition", [](Settings& s) { s.partition = static_cast<PartitionRule>(2); }},
      {"randomization", [](Settings& s) { s.randomization = static_cast<Randomization>(3); }},
      {"interleave columns", [](Settings& s) { s.interleave.n = 17; }},
      {"interleave rows", [](Settings& s) { s.interleave.m = 0; }},
      {"direct-vpls", [](Settings& s) { s.directVpls = 65537; }},
      {"indirect-vpls", [](Settings& s) { s.indirectVpls = -1; }},
      {"photons", [](Settings& s) { s.photons = 16777217; }},
      {"resampling", [](Settings& s) { s.resampling = 0; }},
      {"camera-points", [](Settings& s) { s.cameraPoints = 0; }},
      {"path-length", [](Settings& s) { s.pathLength = -1; }},
      {"specular-depth", [](Settings& s) { s.specularDepth = 0; }},
      {"bound", [](Settings& s) { s.bound = NAN; }},
      {"bound", [](Settings& s) { s.bound = 2e12f; }},
      {"photon-radius", [](Settings& s) { s.photonRadius = 0; }},
      {"photon-radius", [](Settings& s) { s.photonRadius = 1.5f; }},
      {"vpl-roulette", [](Settings& s) { s.vplRoulette = -1; }},
      {"vpl-roulette", [](Settings& s) { s.vplRoulette = NAN; }},
      {"environment", [](Settings& s) { s.environment.y = -1; }},
      {"environment", [](Settings& s) { s.environment.x = INFINITY; }},
      {"environment", [](Settings& s) { s.environment.z = 2e6f; }},
      {"camera eye", [](Settings& s) { s.camera.eye.z = NAN; }},
      {"camera forward", [](Settings& s) { s.camera.forward = Vec3(0); }},
      {"camera up", [](Settings& s) { s.camera.up = s.camera.forward; }},
      {"field of view", [](Settings& s) { s.camera.verticalFov = 4; }},
      {"orthographic height", [](Settings& s) { s.camera.orthographicHeight = -1; }},
      {"orthographic height", [](Settings& s) { s.camera.orthographicHeight = NAN; }},
  };
  for (const auto& [field, spoil] : cases) {
    const std::string text = refusal(spoil);
    EXPECT_NE(text.find(field), std::string::npos) << field << ": " << text;
    EXPECT_NE(text.find("Configure"), std::string::npos) << text;
  }
}

// A Configure whose list of settings somebody has spoilt.
std::string refusalOfList(const std::function<void(pb::Settings&)>& spoil) {
  Frame frame = encodeMessage(msg::Configure{});
  pb::Configure configure;
  EXPECT_TRUE(configure.ParseFromString(frame.header));
  spoil(*configure.mutable_settings());
  configure.SerializeToString(&frame.header);
  try {
    decodeMessage(std::move(frame), Peer::master);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// None is forgotten, none is there twice, none is unknown, and each holds the numbers that it
// should.
TEST(Messages, ListsOfSettingsAreComplete) {
  EXPECT_EQ(refusalOfList([](pb::Settings&) {}), "");
  int place = 0;
  forEachSetting([&](const auto& row) {
    const auto isNamed = [&](const std::function<void(pb::Settings&)>& spoil) {
      return refusalOfList(spoil).find(row.name) != std::string::npos;
    };
    const int i = place++;
    EXPECT_TRUE(isNamed([&](pb::Settings& s) { s.mutable_setting()->DeleteSubrange(i, 1); }));
    EXPECT_TRUE(isNamed([&](pb::Settings& s) { *s.add_setting() = s.setting(i); }));
    EXPECT_TRUE(isNamed([&](pb::Settings& s) { s.mutable_setting(i)->add_whole(0); }));
    EXPECT_TRUE(isNamed([&](pb::Settings& s) { s.mutable_setting(i)->add_real(0); }));
    EXPECT_TRUE(isNamed([&](pb::Settings& s) {
      pb::Setting& setting = *s.mutable_setting(i);
      if (setting.has_camera())
        setting.clear_camera();
      else
        setting.mutable_camera();
    }));
  });
  const std::string unknown =
      refusalOfList([](pb::Settings& s) { s.add_setting()->set_name("voodoo\n"); });
  EXPECT_NE(unknown.find("voodoo?"), std::string::npos) << unknown;
}

TEST(Messages, EverySettingArrives) {
  const Frame sent = encodeMessage(msg::Configure{3, 4, oddSettings()});
  const Message received = decodeMessage(Frame(sent), Peer::master);
  EXPECT_EQ(std::get<msg::Configure>(received).settings, oddSettings());
  forEachSetting([](const auto& row) {
    EXPECT_FALSE(oddSettings().*row.member == Settings{}.*row.member) << row.name << " is not odd";
  });
}

TEST(Messages, DeliveriesOutOfRangeAreNamed) {
  const std::pair<const char*, std::function<void(msg::Configure&)>> cases[] = {
      {"level", [](msg::Configure& m) { m.delivery.level = 20; }},
      {"form", [](msg::Configure& m) { m.delivery.form = static_cast<Delivery::Form>(3); }},
      {"filter", [](msg::Configure& m) { m.delivery.filter = static_cast<SurfaceTest>(9); }},
      {"exposure", [](msg::Configure& m) { m.delivery.exposure = 51; }},
      {"exposure", [](msg::Configure& m) { m.delivery.exposure = NAN; }},
      {"tone curve", [](msg::Configure& m) { m.delivery.curve = static_cast<ToneCurve>(3); }},
      {"too large",
       [](msg::Configure& m) {
         m.delivery.form = Delivery::Form::display, m.settings.interleave = {5, 4};
       }},
  };
  for (const auto& [field, spoil] : cases) {
    msg::Configure configure;
    EXPECT_EQ(refusal(Message(configure)), "");
    spoil(configure);
    const std::string text = refusal(Message(configure));
    EXPECT_NE(text.find(field), std::string::npos) << field << ": " << text;
  }
}

TEST(Messages, OtherFieldsOutOfRangeAreNamed) {
  const std::pair<const char*, Message> cases[] = {
      {"threads", msg::Hello{1, "r", "n", 0, "i", "p"}},
      {"threads", msg::Hello{1, "r", "n", 1025, "i", "p"}},
      {"blob size", msg::SceneOffer{1, {{someHash(1), kMaxBlobBytes + 1, BlobKind::rest}}}},
      {"blob size", msg::SceneOffer{1, {{someHash(1), 0, BlobKind::rest}}}},
      {"blob kind", msg::SceneOffer{1, {{someHash(1), 1, static_cast<BlobKind>(9)}}}},
      {"offset", msg::BlobChunk{someHash(1), 11, 10, Bytes(1, std::byte{0})}},
      {"size", msg::BlobChunk{someHash(1), 8, 10, Bytes(3, std::byte{0})}},
      {"size", msg::BlobChunk{someHash(1), 8, 10, {}}},
      {"total", msg::BlobChunk{someHash(1), 0, kMaxPackedBytes + 1, Bytes(1, std::byte{0})}},
      {"done", msg::Progress{Phase::fetching, 6, 5}},
      {"phase", msg::Progress{static_cast<Phase>(7), 1, 5}},
      {"extra mask", msg::Tasks{1, {}, {{0, 0, 64}}}},
      {"phase", msg::Tasks{1, {}, {{0, 256, 0}}}},
      {"photon radius", msg::Tasks{1, {0, 0, 0, NAN}, {{0, 0, 0}}}},
      {"allowed time", msg::Tasks{1, {}, {{0, 0, 0}}, 1, false, Duration(0)}},
      {"allowed time", msg::Tasks{1, {}, {{0, 0, 0}}, 1, false, std::chrono::hours(1001)}},
      {"sets made", msg::Result{1, 1, 1, 1, 1, 257, 0, 0, {}, {}}},
      {"replaced in", msg::Result{1, 1, 1, 1, 1, 0, 1, kAllTileFields + 1, {}, {}}},
      {"blob kind", msg::SceneOffer{1, {{someHash(1), 1, BlobKind::page}}}},
  };
  for (const auto& [field, message] : cases) {
    const std::string text = refusal(Message(message));
    EXPECT_NE(text.find(field), std::string::npos) << field << ": " << text;
  }
}

// What the light of a frame is made for, as the settings' own camera.
TEST(Messages, LightCamerasOutOfRangeAreNamed) {
  const auto with = [](const Camera& camera) {
    return refusal(msg::Tasks{1, {0, 0, 0, 0, {Camera{}, camera}}, {{0, 0, 0}}});
  };
  EXPECT_EQ(with(Camera{}), "");
  Camera camera;
  camera.eye.y = INFINITY;
  EXPECT_NE(with(camera).find("camera eye"), std::string::npos);
  camera = {}, camera.verticalFov = NAN;
  EXPECT_NE(with(camera).find("field of view"), std::string::npos);

  Frame frame = encodeMessage(Message(oneOfEach()[9]));
  pb::Tasks tasks;
  ASSERT_TRUE(tasks.ParseFromString(frame.header));
  *tasks.mutable_frame()->add_light_cameras() = tasks.frame().light_cameras(0);
  tasks.SerializeToString(&frame.header);
  try {
    decodeMessage(std::move(frame), Peer::master);
    FAIL() << "nine are accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("9 light cameras"), std::string::npos) << error.what();
  }
}

// A Goodbye as a hostile peer may write it: field 1, length, bytes.
Frame goodbye(const std::string& text) {
  std::string header = "\x0a";
  header += static_cast<char>((text.size() & 0x7f) | 0x80);
  header += static_cast<char>(text.size() >> 7);
  return {static_cast<uint16_t>(MessageType::goodbye), header + text, {}};
}

TEST(Messages, TextsThatCouldHarmATerminalAreRefused) {
  for (const char* good : {"", "done", "ende gut, \xc3\x9c ok", "\xe2\x82\xac", "\xf0\x9f\x8e\xb2"})
    EXPECT_EQ(std::get<msg::Goodbye>(decodeMessage(goodbye(good), Peer::client)).reason, good);
  for (const std::string& bad :
       {std::string("two\nlines"), std::string("\x1b[2J"), std::string("\x7f"),
        std::string("\0", 1),
        std::string("\xc2\x9b"
                    "2J"),
        std::string("\xff"), std::string("\xc3"), std::string("\xc0\xaf"),
        std::string("\xed\xa0\x80"), std::string("\xf4\x90\x80\x80"), std::string(257, 'x')})
    EXPECT_THROW(decodeMessage(goodbye(bad), Peer::client), Error) << bad;
}

TEST(Messages, OurOwnTextsAreMadeToFit) {
  const auto sent = [](const std::string& text) {
    return std::get<msg::Goodbye>(decodeMessage(encodeMessage(msg::Goodbye{text}), Peer::client))
        .reason;
  };
  EXPECT_EQ(sent("a\nb\x1b\xff"
                 "c"),
            "a?b??c");
  EXPECT_EQ(sent(std::string(300, 'x')), std::string(kMaxText, 'x'));
  std::string euros;
  for (int i = 0; i < 100; ++i) euros += "\xe2\x82\xac";
  EXPECT_EQ(sent(euros), euros.substr(0, 255)) << "cut between characters";
}

TEST(Messages, GarbledHeadersEndInAnErrorOrAMessage) {
  std::mt19937 random(7);
  for (const Message& message : oneOfEach()) {
    const Frame good = encodeMessage(Message(message));
    for (int i = 0; i < 500; ++i) {
      Frame bad = good;
      if (bad.header.empty()) continue;
      bad.header[random() % bad.header.size()] = static_cast<char>(random());
      if (i % 3 == 0) bad.header.resize(random() % bad.header.size());
      try {
        encodeMessage(decodeMessage(std::move(bad), senderOf(message)));
      } catch (const Error&) {
      }
    }
  }
}

TEST(Messages, LargestListsFitTheirLimits) {
  msg::SceneOffer offer{~0u, {}};
  offer.blobs.assign(kMaxBlobs, {someHash(0xff), kMaxBlobBytes, BlobKind::meshes});
  EXPECT_EQ(refusal(Message(offer)), "");
  Camera longNamed = oddSettings().camera;
  longNamed.name.assign(kMaxText, 'x');
  msg::Tasks tasks{~0u, {~0u, ~0u, ~0u, 1e30f, std::vector(kMostLightCameras, longNamed), ~0u}, {}};
  tasks.items.assign(kMaxTasksPerMessage, {~0u, 255, 31});
  EXPECT_EQ(refusal(Message(tasks)), "");
}

}  // namespace
}  // namespace ninefold
