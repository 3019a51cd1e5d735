// Whom the server talks to.
#include "master/web/web_access.h"

#include <gtest/gtest.h>

#include <set>

namespace ninefold {
namespace {

const WebIdentity kPlain{false, {"render1"}};
const WebIdentity kSecure{true, {"render1", "*.example.org"}};

TEST(WebAccess, AHostIsAnAddressOrANameOfOurs) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "10.1.2.3:1", "[::1]:8080", "[fd00::1]",
                           "localhost", "LocalHost:99", "render1", "RENDER1:8080"})
    EXPECT_TRUE(isOurHost(host, kPlain)) << host;
  for (const char* host : {"", ":80", "evil.test", "evil.test:8080", "127.0.0.1.evil.test",
                           "localhost.evil.test", "render1.evil.test", "1.2.3", "1.2.3.4.5", "[",
                           "[]", "[evil.test]:80", "render", "render11"})
    EXPECT_FALSE(isOurHost(host, kPlain)) << host;
}

TEST(WebAccess, AStarIsOneLabel) {
  EXPECT_TRUE(isOurHost("a.example.org:443", kSecure));
  EXPECT_TRUE(isOurHost("A.Example.ORG", kSecure));
  for (const char* host : {"example.org", ".example.org", "a.b.example.org", "aexample.org"})
    EXPECT_FALSE(isOurHost(host, kSecure)) << host;
}

TEST(WebAccess, AnOriginIsOurSchemeAndTheHost) {
  EXPECT_TRUE(isOurOrigin("http://render1:8080", "render1:8080", kPlain));
  EXPECT_TRUE(isOurOrigin("https://render1", "RENDER1", kSecure));
  for (const char* origin : {"", "null", "http://", "https://render1:8080", "http://render1",
                             "http://render1:8081", "http://evil.test", "http://render1:8080/"})
    EXPECT_FALSE(isOurOrigin(origin, "render1:8080", kPlain)) << origin;
}

TEST(WebAccess, TokensAreLongAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) {
    const std::string token = newToken();
    EXPECT_EQ(token.size(), 64u);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos) << token;
    tokens.insert(token);
  }
  EXPECT_EQ(tokens.size(), 100u);
}

TEST(WebAccess, OnlyTheWholeTokenIsRight) {
  const std::string token = newToken();
  EXPECT_TRUE(isRightToken(token, token));
  EXPECT_FALSE(isRightToken("", token));
  EXPECT_FALSE(isRightToken(token.substr(1), token));
  EXPECT_FALSE(isRightToken(token + "0", token));
  for (size_t i = 0; i < token.size(); ++i) {
    std::string other = token;
    other[i] = other[i] == '0' ? '1' : '0';
    EXPECT_FALSE(isRightToken(other, token)) << i;
  }
}

TEST(WebAccess, ABearerIsWhatFollowsTheWord) {
  EXPECT_EQ(bearerOf("Bearer abc"), "abc");
  for (const char* header : {"", "Bearer", "bearer abc", "Basic abc", " Bearer abc"})
    EXPECT_EQ(bearerOf(header), "") << header;
}

}  // namespace
}  // namespace ninefold
