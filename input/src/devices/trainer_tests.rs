//! A trainer that dies without a word must be noticed, and one that rests must not be taken for it.
use std::net::TcpListener;

use super::*;

/// Both ends of a connection.
fn ends() -> (TcpStream, TcpStream) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let stream = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
    (stream, listener.accept().unwrap().0)
}

/// Reads a request of this length and answers it.
fn serve(trainer: &mut TcpStream, length: usize, response: u8, data: &[u8]) -> Vec<u8> {
    let mut request = vec![0; length];
    trainer.read_exact(&mut request).unwrap();
    let answer = DirectConnectMessage { kind: request[1], sequence: request[2], response, data };
    trainer.write_all(&answer.to_bytes()).unwrap();
    request
}

/// Link to a trainer with a fitness machine, whose control point can be written or not, and the trainer's end.
fn link_with(control: u8) -> (TrainerLink, TcpStream) {
    let (stream, mut trainer) = ends();
    let begun = std::thread::spawn(move || TrainerLink::begin(stream, Arc::default()).unwrap());
    let bike = [&uuid(INDOOR_BIKE_DATA)[..], &[CAN_NOTIFY]].concat();
    let list = [&uuid(FITNESS_MACHINE)[..], &bike, &uuid(CONTROL_POINT), &[control]].concat();
    for (length, data) in [(6, &list[..16]), (22, &list), (23, &list[16..32])] {
        serve(&mut trainer, length, 0, data);
    }
    (begun.join().unwrap(), trainer)
}

/// Link to a trainer without a control point, and the trainer's end.
fn link() -> (TrainerLink, TcpStream) {
    link_with(0)
}

#[test]
fn a_silent_trainer_is_asked_for_a_sign_of_life_and_then_gone() {
    let (mut link, mut trainer) = link();
    trainer.set_read_timeout(Some(ANSWER_WAIT)).unwrap();
    let mut bytes = Vec::new();
    let ago = |wait: Duration| Instant::now().checked_sub(wait + READ_WAIT).unwrap();
    (link.last_heard, link.last_asked) = (ago(ASK_AFTER), ago(ASK_AFTER));
    for _ in 0..3 {
        link.read(&mut bytes).unwrap();
    }
    // One request, not three.
    let mut request = [0; 6];
    trainer.read_exact(&mut request).unwrap();
    assert_eq!((request[1], request[4..].to_vec()), (SERVICES, vec![0, 0]));
    trainer.set_read_timeout(Some(READ_WAIT)).unwrap();
    assert!(trainer.read(&mut request).is_err());
    // Whoever answers lives.
    let answer = DirectConnectMessage { kind: SERVICES, sequence: request[2], response: 0, data: &[] };
    trainer.write_all(&answer.to_bytes()).unwrap();
    link.read(&mut bytes).unwrap();
    assert!(link.last_heard.elapsed() < ASK_AFTER);
    link.last_heard = ago(SILENCE);
    assert_eq!(link.read(&mut bytes).unwrap_err().to_string(), "silent for 10 s");
    assert!(bytes.is_empty() && link.broken);
}

#[test]
fn bytes_without_a_whole_message_are_silence() {
    let (mut link, mut trainer) = link();
    // The length promises 4096 bytes, of which the trainer sends one now and then.
    trainer.write_all(&[1, 6, 0, 0, 16, 0, 7]).unwrap();
    let heard = link.last_heard;
    link.read(&mut Vec::new()).unwrap();
    assert_eq!(link.last_heard, heard);
}

#[test]
fn a_trainer_that_sends_other_messages_is_waited_for_no_longer_than_a_silent_one() {
    let (stream, mut trainer) = ends();
    let data = uuid(0x2ada);
    let other = DirectConnectMessage { kind: NOTIFICATION, sequence: 0, response: 0, data: &data }.to_bytes();
    let trickle = std::thread::spawn(move || {
        for length in [6, 22, 23] {
            for _ in 0..15 {
                std::thread::sleep(Duration::from_millis(100));
                if trainer.write_all(&other).is_err() {
                    return;
                }
            }
            serve(&mut trainer, length, 0, &uuid(FITNESS_MACHINE));
        }
    });
    let began = Instant::now();
    let told = TrainerLink::begin(stream, Arc::default()).err().unwrap().to_string();
    assert!(told.contains("it says nothing"), "{told}");
    assert!(began.elapsed() < ANSWER_WAIT + Duration::from_millis(500), "{:?}", began.elapsed());
    trickle.join().unwrap();
}

#[test]
fn the_release_waits_for_the_command_before_it_and_repeats_what_is_refused() {
    let (mut link, mut trainer) = link_with(CAN_WRITE);
    serve(&mut trainer, 23, 0, &uuid(CONTROL_POINT));
    link.read(&mut Vec::new()).unwrap();
    let ends = std::thread::spawn(move || drop(link));
    let nothing_comes = |trainer: &mut TcpStream| {
        trainer.set_read_timeout(Some(Duration::from_millis(120))).unwrap();
        assert!(trainer.read(&mut [0; 64]).is_err());
        trainer.set_read_timeout(Some(ANSWER_WAIT)).unwrap();
    };
    let indicate = |trainer: &mut TcpStream, command: u8| {
        let data = [&uuid(CONTROL_POINT)[..], &[0x80, command, 1]].concat();
        let indication = DirectConnectMessage { kind: NOTIFICATION, sequence: 0, response: 0, data: &data };
        trainer.write_all(&indication.to_bytes()).unwrap();
    };
    // The ride ends while control is asked for.
    let asked = serve(&mut trainer, 23, 0, &uuid(CONTROL_POINT));
    assert_eq!(asked[22..], [0]);
    nothing_comes(&mut trainer);
    indicate(&mut trainer, 0);
    let level = [0x11, 0, 0, 0, 0, 40, 51];
    assert_eq!(serve(&mut trainer, 29, 6, &uuid(CONTROL_POINT))[22..], level);
    // The repeated write is not answered by a late answer to another.
    let mut again = [0; 29];
    trainer.read_exact(&mut again).unwrap();
    assert_eq!(again[22..], level);
    let answer = |sequence| DirectConnectMessage { kind: WRITE, sequence, response: 0, data: &[] }.to_bytes();
    indicate(&mut trainer, 0x11);
    trainer.write_all(&answer(asked[2])).unwrap();
    nothing_comes(&mut trainer);
    trainer.write_all(&answer(again[2])).unwrap();
    assert_eq!(serve(&mut trainer, 23, 0, &uuid(CONTROL_POINT))[22..], [1]);
    assert_eq!(trainer.read(&mut [0; 64]).unwrap(), 0, "nothing but an ordinary end follows");
    ends.join().unwrap();
}

#[test]
fn a_port_that_is_connected_to_itself_is_no_trainer() {
    let socket = socket2::Socket::new(socket2::Domain::IPV4, socket2::Type::STREAM, None).unwrap();
    socket.bind(&std::net::SocketAddr::from(([127, 0, 0, 1], 0)).into()).unwrap();
    socket.connect(&socket.local_addr().unwrap()).unwrap();
    assert!(connected(Ok(socket.into())).unwrap_err() == DeviceFault::NoTrainerThere);
    let (stream, _trainer) = ends();
    assert!(connected(Ok(stream)).is_ok());
}

#[test]
fn a_trainer_without_a_control_point_is_told() {
    let (link, _trainer) = link();
    assert_eq!(link.note(), Some(DeviceNote::NoControlPoint));
}
