//! Law: the triangles and numbers that Google's encoder was given come out, to the precision of the quantisation, by
//! every method that it writes; and no bytes make the decoder panic or take memory beyond the budget. A wrong
//! decoder would move corners, or confuse the points of seams.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use super::{Attribute, DracoMesh, decode};
use crate::DecodeError;
use crate::mutations::{hex, mutations};
use regular_file::Budget;
use std::collections::BTreeSet;

/// Edgebreaker by valences, and the predictions of the slowest speed.
const SHEET_VALENCE: &str = "\
    445241434f0202010100000010120412020006efd3ea53ad1aff0111ff026b41ff026b41ff026b41ff026b4105ff00010000\
    0001000002000003000001000903000002010109030001030103090200020201020204010301010404040004010101010105\
    ad05012cffffffffff4b550103ad02ffffffffff47ad025505ad0255050cd976f597cd5af66a9f7f7db000000000ff030000\
    000000000000000000000000000040400a06030100090301040f0110010801240600be1ed675807fc01ff007786944cbbc3a\
    5c18d3328f2eaf8ef1052d1b5df2e8d232ff0000007f00000060046095988908050101000b03010c010413011c010c010806\
    0019bca3cf6eaaaeaa6aaa00e1acac1201486a6a6aea430088aab0a6f2792211000e0000001203f8308200000000ff030000\
    00000000000000000000803f0a0101010105800201390101ff3701029701010101ffdb010137010109003b28bf7ebeff5e80\
    00000000ff000000010101010505013a0102010303010107006a9c0f90bf8b000000002c010000";
/// Edgebreaker by symbols, with metadata.
const SHEET_EDGEBREAKER: &str = "\
    445241434f0202010100800002076d61646520627906612074657374016e0407000000000010120412020006efd3ea53ad1a\
    ff0111ff026b41ff026b41ff026b41ff026b4105ff0000000000010000020000030000010009030000020101090300010301\
    03090200020201020204010301010404040004010101010102ad05012cffffffffff4b550103ad02ffffffffff47ad025505\
    ad0255050cd976f597cd5af66a9f7f7db000000000ff030000000000000000000000000000000040400a0003010101810101\
    28fff70116010207005fff09604a82ff0000007f00000008010101000b0301341f010c0400bebf81aaaeaa6aaa00a80a0000\
    0000000000ff03000000000000000000000000803f0a0101010102800201390101ff3701029701010101ffdb010137010109\
    003b28bf7ebeff5e8000000000ff000000010101010205013a0102010303010107006a9c0f90bf8b000000002c010000";
/// Edgebreaker, differences only.
const SHEET_FAST: &str = "\
    445241434f0202010100000010120012020006efd3ea53ad1aff011101ff0000050009030000010903000103090200020202\
    0401030404040004020302010100010101028008ad0a035501ffffffffff3fad0255015505ad02ffffffffff47ad0ead1255\
    015501ffffffffff4701041305a2e0b49ae3d6ed6569b0418f173f4262925b00000000ff030000000301010181010128fff7\
    0116010207005fff09604a82ff0000007f0000000001010101ad050110030102ffffffffffffffffffff9701120118010201\
    020a808dbf6a6e1a38629f4e00000000ff0300000001010102800201260101ff33010401079701050105ffd7010201013701\
    0113c0e161cfe12c05a2ae3ef8650b90ebbfeffb8100000000ff000000000101000403010c012c010805004c731e82226280\
    602091908020206080d0010601000000002c010000000000000000000000000000000040400a080000000000000000000080\
    3f0a";
/// Triangles one after the other.
const SHEET_SEQUENTIAL: &str = "\
    445241434f020201000000121001000104010504010205020605020306030706040508050908050609060a0906070a070b0a\
    08090c090d0c090a0d0a0e0d0a0b0e0b0f0e0105000903000001090300010309020002020204010304040400040203020101\
    000101010180080114030104ffffffffff43ad025505ad0affffffffff4b0114ffffffffff4f5501104e80a3f2b27ca4507e\
    67124521d584bc00000000ff030000000301010181010114fff70122010a0880f3e5b91e064a8cff0000007f000000000101\
    0101ab05011c030106ffffffffffffffffffff9b011e08002d7c44ac85338200000000ff03000000010101018002012c0101\
    ff37010c9b0103ffd701033b01010e805c2274f44ead8b5e10cd0fc98100000000ff000000000101010106012d0101010f07\
    01030c40b20d32817a54107adb5180000000002c010000000000000000000000000000000040400a08000000000000000000\
    00803f0a";
/// Positions that are not quantised.
const SHEET_PLAIN: &str = "\
    445241434f020201000000121001000104010504010205020605020306030706040508050908050609060a0906070a070b0a\
    08090c090d0c090a0d0a0e0d0a0b0e0b0f0e01010009030000000000000000000000000000000000803f000000000000003f\
    00000040000000000000000000004040000000000000003f000000000000803f0000803f0000803f0000803f0000c03f0000\
    00400000803f0000803f000040400000803f0000c03f0000000000000040000000000000803f000000400000003f00000040\
    000000400000000000004040000000400000003f00000000000040400000803f0000803f000040400000c03f000000400000\
    40400000803f00004040000040400000c03f";
/// Box with seams on every edge, by valences.
const BOX_VALENCE: &str = "\
    445241434f02020101000000080c020b010003af3e0a010110550414b50d47550414b50d4703ff0001000100010100010009\
    03000002010109030001030103090200020201010100030301280118030084b0171280010000000000ff030000000080bf00\
    0080bf000080bf000000400a06030101030101400100ff0000007f000000ff02a14108050101010403ad2a550d01080aba14\
    725865f4c2c91b820c000000150303e08100000000ff03000000000000000000000000803f0a";
/// Box with seams on every edge, by symbols.
const BOX_EDGEBREAKER: &str = "\
    445241434f02020101000000080c020b010003af3e0a010110550414b50d47550414b50d4703ff0000000100010100010009\
    03000002010109030001030103090200020201010100030301280118030084b0171280010000000000ff030000000080bf00\
    0080bf000080bf000000400a0003010102ff015535fff7ad06ad02fff3550108090ed92b92757b80ff0000007f0000000801\
    0101010103ad1e0114550d0b427d41a3ae46eb1bcb064900000000ff03000000000000000000000000803f0a";

/// Numbers of one vertex: position, normal, texture coordinate, colour, joints.
type Numbers = Vec<Vec<f32>>;

/// Sheet of 4 × 4 vertices that the encoder was given, and its triangles.
fn sheet() -> (Vec<Numbers>, Vec<[usize; 3]>) {
    let vertex = |index: usize| {
        let [i, j] = [index % 4, index / 4];
        let mut normal = vec![0.0; 3];
        normal[(i + j) % 3] = 1.0;
        let [x, y] = [i as f32, j as f32];
        vec![
            vec![x, y, 0.5 * ((i * i + 2 * j) % 4) as f32],
            normal,
            vec![x / 3.0, y / 3.0],
            vec![40.0 * x / 255.0, 60.0 * y / 255.0, 1.0, 128.0 / 255.0],
            vec![x, y, 0.0, 300.0],
        ]
    };
    let corners = (0..9).map(|cell| cell / 3 * 4 + cell % 3);
    let triangles = corners.flat_map(|a| [[a, a + 1, a + 4], [a + 1, a + 5, a + 4]]).collect();
    ((0..16).map(vertex).collect(), triangles)
}

/// Box whose six sides have four vertices each, with normals and texture coordinates of their own.
fn cube() -> (Vec<Numbers>, Vec<[usize; 3]>) {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for (axis, sign) in (0..3).flat_map(|axis| [(axis, -1.0), (axis, 1.0)]) {
        let n = vertices.len();
        for [u, v] in [[0.0_f32, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
            let [mut position, mut normal] = [vec![0.0; 3], vec![0.0; 3]];
            position[axis] = sign;
            position[(axis + 1) % 3] = 2.0 * u - 1.0;
            position[(axis + 2) % 3] = 2.0 * v - 1.0;
            normal[axis] = sign;
            vertices.push(vec![position, normal, vec![u, v]]);
        }
        let two = [[n, n + 1, n + 2], [n + 1, n + 3, n + 2]];
        triangles.extend(if sign > 0.0 { two } else { two.map(|[a, b, c]| [a, c, b]) });
    }
    (vertices, triangles)
}

fn decoded(text: &str) -> DracoMesh {
    decode(&hex(text), &Budget::default()).unwrap()
}

fn of_point(attribute: &Attribute, point: usize) -> &[f32] {
    &attribute.values[attribute.components * point..][..attribute.components]
}

/// Vertex of the original that a decoded point is, by all its numbers.
fn original(mesh: &DracoMesh, point: usize, vertices: &[Numbers]) -> usize {
    // Of positions, normals and texture coordinates a step of the quantisation is about 0.004.
    let near = |found: &[f32], wanted: &[f32]| found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 0.005);
    let same = |numbers: &Numbers| {
        mesh.attributes.iter().zip(numbers).all(|(attribute, wanted)| near(of_point(attribute, point), wanted))
    };
    vertices.iter().position(same).unwrap_or_else(|| panic!("point {point} is no vertex of the original"))
}

/// Triangles of the original that a decoded mesh has, their first corner the least.
fn triangles(mesh: &DracoMesh, vertices: &[Numbers]) -> Vec<[usize; 3]> {
    let of_face = |face: &[u32]| from_least([0, 1, 2].map(|corner| original(mesh, face[corner] as usize, vertices)));
    mesh.indices.chunks(3).map(of_face).collect()
}

fn from_least([a, b, c]: [usize; 3]) -> [usize; 3] {
    [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap()
}

#[test]
fn every_method_gives_the_triangles_that_were_encoded() {
    let files = [
        (SHEET_VALENCE, sheet()),
        (SHEET_EDGEBREAKER, sheet()),
        (SHEET_FAST, sheet()),
        (SHEET_SEQUENTIAL, sheet()),
        (SHEET_PLAIN, sheet()),
        (BOX_VALENCE, cube()),
        (BOX_EDGEBREAKER, cube()),
    ];
    for (text, (vertices, faces)) in files {
        let mesh = decoded(text);
        assert_eq!(mesh.points, vertices.len());
        let found = triangles(&mesh, &vertices);
        assert_eq!(found.len(), faces.len());
        let sets = [found, faces].map(|faces| faces.into_iter().map(from_least).collect::<BTreeSet<_>>());
        assert_eq!(sets[0], sets[1]);
        let identities: Vec<u32> = mesh.attributes.iter().map(|attribute| attribute.unique_id).collect();
        let components: Vec<usize> = mesh.attributes.iter().map(|attribute| attribute.components).collect();
        assert_eq!(identities, (0..mesh.attributes.len() as u32).collect::<Vec<_>>());
        assert_eq!(components, [3, 3, 2, 4, 4][..if text == SHEET_PLAIN { 1 } else { vertices[0].len() }]);
    }
}

#[test]
fn what_is_not_quantised_comes_out_to_the_bit() {
    let (vertices, _) = sheet();
    let mesh = decoded(SHEET_PLAIN);
    for point in 0..mesh.points {
        let vertex = original(&mesh, point, &vertices);
        assert_eq!(of_point(&mesh.attributes[0], point), vertices[vertex][0]);
    }
    // Integers too.
    let mesh = decoded(SHEET_VALENCE);
    for point in 0..mesh.points {
        let vertex = original(&mesh, point, &vertices);
        assert_eq!(of_point(&mesh.attributes[3], point), vertices[vertex][3]);
        assert_eq!(of_point(&mesh.attributes[4], point), vertices[vertex][4]);
    }
}

#[test]
fn memory_is_taken_before_it_is_needed_and_only_the_mesh_stays_taken() {
    let budget = Budget::default();
    let mesh = decode(&hex(SHEET_EDGEBREAKER), &budget).unwrap();
    let numbers: usize = mesh.attributes.iter().map(|attribute| attribute.values.len()).sum();
    assert_eq!(budget.left(), Budget::DEFAULT - 4 * (numbers + mesh.indices.len()) as u64);

    // A file that claims 2²⁸ points in a few bytes, and one that claims as many triangles.
    let head = hex("445241434f02020100000000");
    for counts in ["01ffffff7f", "ffffff7f10"] {
        let bytes = [&head[..11], &hex(counts), &[0, 0, 0, 0]].concat();
        let budget = Budget::default();
        assert!(matches!(decode(&bytes, &budget), Err(DecodeError::OverBudget(_))));
        assert_eq!(budget.left(), Budget::DEFAULT);
    }
}

#[test]
fn what_is_no_mesh_of_a_known_version_is_said() {
    let said = |bytes: &[u8]| decode(bytes, &Budget::default()).unwrap_err().to_string();
    let mut bytes = hex(SHEET_FAST);
    assert!(said(b"DRACULA").contains("do not begin as Draco does"));
    assert!(said(&bytes[..12]).contains("end too early"));
    bytes[5] = 1;
    assert!(said(&bytes).contains("version 1.2, where 2.2 is known"));
    // Clouds of points are none, whatever their version.
    bytes[7] = 0;
    assert!(said(&bytes).contains("without triangles"));
    // Metadata within metadata, without end.
    let deep = [&hex("445241434f0202010100800000")[..], &[1, 0].repeat(500)].concat();
    assert!(said(&deep).contains("nested too deeply"));
}

#[test]
fn mutated_meshes_end_in_numbers_or_a_sentence() {
    const LIMIT: u64 = 20_000_000;
    let files = [SHEET_VALENCE, SHEET_EDGEBREAKER, SHEET_FAST, SHEET_SEQUENTIAL, BOX_VALENCE, BOX_EDGEBREAKER];
    for bytes in files.into_iter().flat_map(|text| mutations(&hex(text), 400)) {
        let budget = Budget::new(LIMIT);
        match decode(&bytes, &budget) {
            Ok(mesh) => {
                assert!(mesh.indices.iter().all(|&point| (point as usize) < mesh.points));
                let whole = |attribute: &Attribute| attribute.values.len() == attribute.components * mesh.points;
                assert!(mesh.attributes.iter().all(whole));
            }
            Err(error) => {
                assert!(!error.to_string().is_empty());
                assert_eq!(budget.left(), LIMIT);
            }
        }
    }
}
