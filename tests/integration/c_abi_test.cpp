// Invariant: the C interface does from a C file what the C++ one does, and refuses what is wrong
// without harm. The cases are in
// c_abi_from_c.c and c_abi_changes_from_c.c.
#include "gtest/gtest.h"

extern "C" {
const char* c_abi_drop_a_ball(void);
const char* c_abi_refuse_bad_input(void);
const char* c_abi_read_in_bulk(void);
const char* c_abi_cast_rays(void);
const char* c_abi_change_bodies(void);
const char* c_abi_change_colliders(void);
const char* c_abi_set_contact_data(void);
const char* c_abi_refuse_bad_changes(void);
}

namespace {

TEST(CInterface, DropsABall) { EXPECT_STREQ(c_abi_drop_a_ball(), nullptr); }
TEST(CInterface, RefusesBadInput) { EXPECT_STREQ(c_abi_refuse_bad_input(), nullptr); }
TEST(CInterface, ReadsInBulk) { EXPECT_STREQ(c_abi_read_in_bulk(), nullptr); }
TEST(CInterface, CastsRays) { EXPECT_STREQ(c_abi_cast_rays(), nullptr); }
TEST(CInterface, ChangesBodies) { EXPECT_STREQ(c_abi_change_bodies(), nullptr); }
TEST(CInterface, ChangesColliders) { EXPECT_STREQ(c_abi_change_colliders(), nullptr); }
TEST(CInterface, SetsContactData) { EXPECT_STREQ(c_abi_set_contact_data(), nullptr); }
TEST(CInterface, RefusesBadChanges) { EXPECT_STREQ(c_abi_refuse_bad_changes(), nullptr); }

}  // namespace
