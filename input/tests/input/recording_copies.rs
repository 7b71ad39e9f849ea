//! A copy of a recording by another program must replay as the original, whatever it changes that means nothing: order,
//! numbers, chunks, compression. What would be another ride must be noticed.

use std::collections::BTreeMap;
use std::fs;

use input::recording::{Recording, RecordingError};

use crate::recordings::{
    assert_same_bits, assert_same_ride, both_formats, copied, data_end, description, made, messages, options, place,
    read_bytes, short_ride,
};

/// Copies by other programs, with other chunks or none, compressed, and without checksums, must read the same.
#[test]
fn a_recording_copied_by_another_program_is_the_same() {
    let (bytes, entries) = short_ride();
    for options in [
        options().use_chunks(false),
        options().chunk_size(Some(300)),
        options().calculate_chunk_crcs(false).calculate_data_section_crc(false),
        options().repeat_channels(false).emit_statistics(false).emit_message_indexes(false),
        options().compression(Some(mcap::Compression::Zstd)),
        options().compression(Some(mcap::Compression::Lz4)),
        // The name of the program lost.
        mcap::WriteOptions::new(),
    ] {
        let (found, error) = read_bytes(&copied(&bytes, options));
        assert!(error.is_none(), "{error:?}");
        assert_same_bits(&found, &entries);
    }
}

/// Way of numbering messages.
type Numbering<'a> = dyn FnMut(&mcap::Message<'_>) -> u32 + 'a;

/// Copies number the messages anew: MCAP leaves that to the program.
#[test]
fn a_copy_may_number_the_messages_as_it_likes() {
    for (bytes, entries) in both_formats() {
        let mut counts = BTreeMap::new();
        let mut by_channel = |message: &mcap::Message<'_>| {
            let count = counts.entry(message.channel.id).or_insert(0);
            *count += 1;
            *count - 1
        };
        let mut count = 0;
        let mut from_one = |_: &mcap::Message<'_>| {
            count += 1;
            count
        };
        let ways: [(&str, &mut Numbering<'_>); 3] =
            [("by channel", &mut by_channel), ("from one", &mut from_one), ("zero", &mut |_| 0)];
        for (way, number) in ways {
            let copy = made(options(), |copy| {
                copy.write_metadata(&description(&bytes)).unwrap();
                for mut message in messages(&bytes) {
                    message.sequence = number(&message);
                    copy.write(&message).unwrap();
                }
            });
            assert_same_ride(way, &copy, &entries);
        }
    }
}

/// Copies may hold more than the ride: notes of their own between the messages, a picture, the description at the end.
#[test]
fn a_copy_may_hold_more_and_elsewhere() {
    for (bytes, entries) in both_formats() {
        let copy = made(options().chunk_size(Some(700)), |copy| {
            let (topic, message_encoding) = ("/notes".to_owned(), "json".to_owned());
            let channel = mcap::Channel { id: 77, topic, message_encoding, schema: None, metadata: BTreeMap::new() };
            let channel = std::sync::Arc::new(channel);
            for (sequence, message) in (0..).zip(messages(&bytes)) {
                if sequence % 2 == 0 {
                    let (channel, data) = (channel.clone(), b"{}"[..].into());
                    let (log_time, publish_time) = (message.log_time, message.log_time);
                    copy.write(&mcap::Message { channel, sequence, log_time, publish_time, data }).unwrap();
                }
                copy.write(&message).unwrap();
            }
            let (name, media_type) = ("helmet.txt".to_owned(), "text/plain".to_owned());
            let data = b"the rider wore a helmet"[..].into();
            copy.attach(&mcap::Attachment { log_time: 0, create_time: 0, name, media_type, data }).unwrap();
            copy.write_metadata(&description(&bytes)).unwrap();
        });
        assert_same_ride("more", &copy, &entries);
    }
}

/// Order of the file is nothing that MCAP promises: one channel after the other, or sorted by time.
#[test]
fn a_copy_may_have_another_order() {
    for (bytes, entries) in both_formats() {
        let by_channel = |message: &mcap::Message<'_>| (u64::from(message.channel.id), 0);
        let by_time = |message: &mcap::Message<'_>| (message.log_time, u64::from(message.channel.id));
        for order in [by_channel, by_time] {
            let copy = made(options(), |copy| {
                copy.write_metadata(&description(&bytes)).unwrap();
                let mut messages = messages(&bytes);
                messages.sort_by_key(order);
                messages.iter().for_each(|message| copy.write(message).unwrap());
            });
            assert_same_ride("sorted", &copy, &entries);
        }
    }
}

/// Without a summary, an index or checksums a file is still whole.
#[test]
fn a_copy_may_lack_all_that_is_optional() {
    for (bytes, entries) in both_formats() {
        let bare = options()
            .emit_summary_records(false)
            .emit_summary_offsets(false)
            .emit_message_indexes(false)
            .calculate_chunk_crcs(false)
            .calculate_data_section_crc(false)
            .calculate_summary_section_crc(false);
        assert_same_ride("bare", &copied(&bytes, bare), &entries);
    }
}

/// Two rides in one file must be noticed: whoever has joined them expects both.
#[test]
fn two_rides_in_one_file_are_noticed() {
    let (bytes, entries) = short_ride();
    let (_directory, path) = place();
    fs::write(&path, [bytes.clone(), bytes.clone()].concat()).unwrap();
    let mut recording = Recording::open(&path).unwrap();
    let found: Vec<_> = recording.by_ref().map(Result::unwrap).collect();
    assert_same_bits(&found, &entries);
    assert_eq!(recording.another(), Some(bytes.len() as u64));

    fs::write(&path, &bytes).unwrap();
    let mut recording = Recording::open(&path).unwrap();
    assert_eq!((recording.by_ref().count(), recording.another()), (entries.len(), None));

    // Messages of two rides, merged into one file, and the description of a second ride among them.
    let merged = made(options(), |copy| {
        copy.write_metadata(&description(&bytes)).unwrap();
        messages(&bytes).iter().chain(&messages(&bytes)).for_each(|message| copy.write(message).unwrap());
    });
    let (found, error) = read_bytes(&merged);
    assert_same_bits(&found, &entries);
    assert!(error.unwrap().to_string().contains("two rides"));
    let other = made(options(), |copy| {
        copy.write_metadata(&description(&bytes)).unwrap();
        let mut second = description(&bytes);
        second.metadata.insert("header".to_owned(), "{}".to_owned());
        copy.write_metadata(&second).unwrap();
    });
    assert!(matches!(read_bytes(&other).1, Some(RecordingError::Another { .. })));
}

/// A few compressed bytes that claim to be gigabytes must be refused before they fill the memory.
#[test]
fn a_chunk_that_unpacks_to_gigabytes_is_refused() {
    let (bytes, _) = short_ride();
    for has_checksum in [true, false] {
        let options = options().compression(Some(mcap::Compression::Zstd)).chunk_size(None);
        let bomb = made(options.calculate_chunk_crcs(has_checksum), |copy| {
            copy.write_metadata(&description(&bytes)).unwrap();
            let channel_id = copy.add_channel(0, "/notes", "json", &BTreeMap::new()).unwrap();
            let zeros = vec![0; 64 << 20];
            for sequence in 0..9 {
                let header = mcap::records::MessageHeader { channel_id, sequence, log_time: 0, publish_time: 0 };
                copy.write_to_known_channel(&header, &zeros).unwrap();
            }
        });
        assert!(bomb.len() < 1 << 20);
        let text = read_bytes(&bomb).1.unwrap().to_string();
        assert!(text.contains("the chunk holds"), "{text}");
    }
}

/// Damage of compressed data must be found before or after it is unpacked, and must not stop the program.
#[test]
fn a_flipped_bit_of_a_compressed_copy_is_found() {
    let (bytes, entries) = short_ride();
    for compression in [mcap::Compression::Zstd, mcap::Compression::Lz4] {
        let copy = copied(&bytes, options().compression(Some(compression)));
        for index in 0..data_end(&copy) {
            let mut damaged = copy.clone();
            damaged[index] ^= 1 << (index % 8);
            let (found, error) = read_bytes(&damaged);
            assert_eq!(found, entries[..found.len()], "bit {} of byte {index}", index % 8);
            assert!(error.is_some(), "bit {} of byte {index}", index % 8);
        }
    }
}
