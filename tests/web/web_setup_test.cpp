// When there is a token, and TLS, and what people are told.
#include "master/web/web_setup.h"

#include <gtest/gtest.h>

#include "common/base/error.h"

namespace ninefold {
namespace {

Options at(const std::string& serve) {
  Options options;
  options.serve = serve;
  return options;
}

TEST(WebSetup, LoopbackNeedsATokenAndNoTls) {
  for (const char* address : {"127.0.0.1:0", "[::1]:8080", "localhost:8080"}) {
    const WebSetup setup = webSetup(at(address));
    EXPECT_EQ(setup.token.size(), 64u) << address;
    EXPECT_EQ(setup.tls, nullptr) << address;
    EXPECT_TRUE(setup.identity.names.empty()) << address;
  }
}

TEST(WebSetup, BeyondLoopbackThereAreBothAlways) {
  for (const char* address : {"0.0.0.0:0", "[::]:0", "10.1.2.3:8443", "render1:8443"}) {
    const WebSetup setup = webSetup(at(address));
    EXPECT_EQ(setup.token.size(), 64u) << address;
    ASSERT_TRUE(setup.tls) << address;
    EXPECT_TRUE(setup.identity.isSecure) << address;
    EXPECT_EQ(setup.tls->fingerprint.size(), 32u * 3 - 1) << setup.tls->fingerprint;
  }
}

TEST(WebSetup, EachRunHasItsOwnTokenAndCertificate) {
  const WebSetup one = webSetup(at("0.0.0.0:0")), two = webSetup(at("0.0.0.0:0"));
  EXPECT_NE(one.token, two.token);
  EXPECT_NE(one.tls->fingerprint, two.tls->fingerprint);
}

TEST(WebSetup, TellsWhereToLook) {
  const Options options = at("127.0.0.1:0");
  const WebSetup setup = webSetup(options);
  EXPECT_EQ(webInvitation(options, setup, 8080, {}),
            std::vector<std::string>{"serving at http://127.0.0.1:8080/#token=" + setup.token});
}

TEST(WebSetup, TellsTokenAndFingerprintBeyondLoopback) {
  const Options options = at("0.0.0.0:0");
  const WebSetup setup = webSetup(options);
  const auto lines = webInvitation(options, setup, 8443, {"10.0.0.7", "192.168.1.2"});
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "serving at https://10.0.0.7:8443/#token=" + setup.token);
  EXPECT_EQ(lines[1], "or at https://192.168.1.2:8443/#token=" + setup.token);
  EXPECT_NE(lines[2].find(setup.tls->fingerprint), std::string::npos) << lines[2];
}

TEST(WebSetup, ACertificateThatIsNotThereIsToldInOneLine) {
  Options options = at("127.0.0.1:0");
  options.serveCertificate = "/none/such.pem";
  options.serveKey = "/none/key.pem";
  try {
    webSetup(options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--serve-certificate /none/such.pem"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace ninefold
