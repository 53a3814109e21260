// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/cancel_token.h"

#include <gtest/gtest.h>

#include <thread>

namespace external_command {
namespace {

TEST(CancelToken, IsNeverRaisedByItself) {
  EXPECT_FALSE(CancelToken().isCancelled());
  EXPECT_FALSE(CancelSource().token().isCancelled());
  EXPECT_NO_THROW(CancelToken().throwIfCancelled());
}

TEST(CancelToken, IsRaisedByItsSourceForGood) {
  const CancelSource source;
  const CancelToken token = source.token(), copy = token;
  source.cancel();
  EXPECT_TRUE(token.isCancelled());
  EXPECT_TRUE(copy.isCancelled());
  EXPECT_TRUE(source.token().isCancelled());
  EXPECT_THROW(token.throwIfCancelled(), Cancelled);
}

TEST(CancelToken, IsNotRaisedByAnotherSource) {
  const CancelSource one, other;
  other.cancel();
  EXPECT_FALSE(one.token().isCancelled());
}

TEST(CancelToken, IsRaisedByACopyOfItsSource) {
  const CancelSource source;
  const CancelSource copy = source;
  copy.cancel();
  EXPECT_TRUE(source.token().isCancelled());
}

TEST(CancelToken, OutlivesItsSource) {
  CancelToken token;
  {
    const CancelSource source;
    token = source.token();
    source.cancel();
  }
  EXPECT_TRUE(token.isCancelled());
}

TEST(CancelToken, EndsALoopOfAnotherThread) {
  const CancelSource source;
  std::thread loop([token = source.token()] {
    while (!token.isCancelled()) std::this_thread::yield();
  });
  source.cancel();
  loop.join();
}

}  // namespace
}  // namespace external_command
