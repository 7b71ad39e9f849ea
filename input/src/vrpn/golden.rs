//! Bytes captured from the stock server (07.38) with a NULL tracker "Head" and a Spin tracker "Spin0".

pub const COOKIE: &str = "7672706e3a207665722e2030372e33382020300000000000";
/// Description: sender 1 is "Head".
pub const SENDER: &str = "000000216b027c890009b7cd00000001ffffffff0000000100000005486561640000000000000000";
/// Description: type 4 is `vrpn_Tracker Pos_Quat`.
pub const TYPE: &str = concat!(
    "000000326b027c890009b7ce00000004fffffffe00000008000000167672706e5f547261636b657220506f735f51",
    "75617400000000000000",
);
/// Pose of sender 1, sensor 0, at the origin, not turned.
pub const IDENTITY: &str = concat!(
    "000000586b027c890009d21f00000001000000040000001d",
    "0000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "3ff0000000000000",
);
/// Pose of sender 2, sensor 0, turned about z.
pub const TURNED: &str = concat!(
    "000000586b027c890009bc2b000000020000000400000018",
    "0000000000000000",
    "000000000000000000000000000000000000000000000000",
    "00000000000000000000000000000000",
    "3fef4502a6de9c4e3fcb313bc05f50e8",
);
/// Description: sender 2 is "Spin0"; written by hand, without time and sequence number.
const SPIN: &str =
    concat!("00000022000000000000000000000002ffffffff00000000", "00000006", "5370696e3000", "000000000000",);

pub fn bytes(hex: &str) -> Vec<u8> {
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}

/// Stream of the cookie, both descriptions, both poses, the description of sender 2, and its pose again.
pub fn session() -> Vec<u8> {
    [COOKIE, SENDER, TYPE, IDENTITY, TURNED, SPIN, TURNED].map(bytes).concat()
}
