// What a request gets.
#include "master/web/web_http.h"

#include <gtest/gtest.h>

#include "master/web/page.h"

namespace ninefold {
namespace {

const std::string kMetrics = "ninefold_frames_total 3\n";

WebRequest get(const std::string& target, http::verb method = http::verb::get) {
  WebRequest request(method, target, 11);
  request.set(http::field::host, "127.0.0.1:8080");
  return request;
}

WebSite site() { return {{}, "abc", &kMetrics}; }

http::status statusOf(const WebRequest& request, const WebSite& at = site()) {
  return answerTo(request, at).result();
}

TEST(WebHttp, GivesThePageAndTheMetrics) {
  const WebResponse page = answerTo(get("/"), site());
  EXPECT_EQ(page.result(), http::status::ok);
  EXPECT_EQ(page.body(), kPage);
  EXPECT_EQ(page[http::field::content_type], "text/html; charset=utf-8");
  WebRequest metrics = get("/metrics");
  metrics.set(http::field::authorization, "Bearer abc");
  EXPECT_EQ(answerTo(metrics, site()).body(), kMetrics);
}

TEST(WebHttp, AHeadHasTheLengthAndNoBody) {
  const WebResponse head = answerTo(get("/", http::verb::head), site());
  EXPECT_EQ(head.body(), "");
  EXPECT_EQ(head[http::field::content_length], std::to_string(kPage.size()));
}

TEST(WebHttp, RefusesTheRest) {
  EXPECT_EQ(statusOf(get("/other")), http::status::not_found);
  EXPECT_EQ(statusOf(get("/../etc/passwd")), http::status::not_found);
  EXPECT_EQ(statusOf(get("/live")), http::status::upgrade_required);
  EXPECT_EQ(statusOf(get("/", http::verb::post)), http::status::method_not_allowed);
}

TEST(WebHttp, RefusesForeignHostsAndOrigins) {
  WebRequest none = get("/");
  none.erase(http::field::host);
  WebRequest foreign = get("/");
  foreign.set(http::field::host, "evil.test:8080");
  WebRequest twice = get("/");
  twice.insert(http::field::host, "127.0.0.1:8080");
  WebRequest asked = get("/metrics");
  asked.set(http::field::origin, "http://evil.test");
  for (const WebRequest& request : {none, foreign, twice, asked})
    EXPECT_EQ(statusOf(request), http::status::forbidden) << request[http::field::host];
  WebRequest own = get("/");
  own.set(http::field::origin, "http://127.0.0.1:8080");
  EXPECT_EQ(statusOf(own), http::status::ok);
}

TEST(WebHttp, MetricsNeedTheToken) {
  WebRequest request = get("/metrics");
  EXPECT_EQ(statusOf(request, site()), http::status::unauthorized);
  request.set(http::field::authorization, "Bearer abd");
  EXPECT_EQ(statusOf(request, site()), http::status::unauthorized);
  request.set(http::field::authorization, "Bearer abc");
  EXPECT_EQ(statusOf(request, site()), http::status::ok);
  EXPECT_EQ(statusOf(get("/"), site()), http::status::ok);  // the page has no secret
}

TEST(WebHttp, AWrongTokenIsARefusalAndAMissingPageIsNone) {
  WebRequest request = get("/metrics");
  EXPECT_TRUE(refusalOf(request, site()));
  request.set(http::field::authorization, "Bearer abd");
  EXPECT_TRUE(refusalOf(request, site()));
  request.set(http::field::authorization, "Bearer abc");
  EXPECT_FALSE(refusalOf(request, site()));
  EXPECT_FALSE(refusalOf(get("/"), site()));
  EXPECT_FALSE(refusalOf(get("/favicon.ico"), site()));
  request.set(http::field::host, "evil.test");
  EXPECT_TRUE(refusalOf(request, site()));
}

// SHA-256 in base64, by another program.
TEST(WebHttp, OnlyThePagesOwnScriptAndStyleMayRun) {
  const std::string policy = policyOf("<style></style><script>alert(1)</script>");
  EXPECT_NE(policy.find("style-src 'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='"),
            std::string::npos)
      << policy;
  EXPECT_NE(policy.find("script-src 'sha256-bhHHL3z2vDgxUt0W3dWQOrprscmda2Y5pLsLg4GF+pI='"),
            std::string::npos)
      << policy;
  EXPECT_EQ(answerTo(get("/"), site())["Content-Security-Policy"], policyOf(kPage));
}

TEST(WebHttp, ThePageNeedsNothingFromElsewhere) {
  for (const char* outside : {"http://", "https://", "src=", "@import", "url("})
    EXPECT_EQ(kPage.find(outside), std::string_view::npos) << outside;
}

}  // namespace
}  // namespace ninefold
