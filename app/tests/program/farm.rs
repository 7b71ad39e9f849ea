//! Law: the templates of docs/FARM.md do what they say: a farm's chunks are the pictures of one machine to the bit, a
//! worker that dies is noticed, and what it left is used. A wrong template reports success for frames that are not
//! there.

use crate::runner::rapidity;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const ARGUMENTS: &str = "--scene lattice --size 64x36 --samples 1 --beta 0,0,-0.6";

/// Program that runs jobs of Open Job Description on this machine.
fn openjd() -> PathBuf {
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("openjd").join("bin/openjd");
    assert!(place.exists(), "{} is missing: `make test` installs it", place.display());
    place
}

fn template() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/farm/rapidity.openjd.yaml")
}

/// Runs the job in a folder, with this program in the place of ours.
fn job(folder: &Path, program: &Path) -> Output {
    let parameter = |name: &str, value: &str| ["-p".to_owned(), format!("{name}={value}")];
    let out = folder.join("film.####.png");
    let parameters = [
        parameter("Frames", "0-5,9"),
        parameter("Chunk", "3"),
        parameter("Out", out.to_str().unwrap()),
        parameter("Arguments", ARGUMENTS),
        parameter("Program", program.to_str().unwrap()),
    ];
    let mut command = Command::new(openjd());
    command.arg("run").arg(template()).args(parameters.concat()).current_dir(folder);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap()
}

fn pictures(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let pictures = entries.filter(|path| path.extension().is_some_and(|ending| ending == "png"));
    let named = pictures.filter(|path| !path.file_name().unwrap().to_str().unwrap().starts_with('.'));
    let mut all: Vec<_> =
        named.map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap())).collect();
    all.sort();
    all
}

#[test]
fn a_job_in_chunks_outlives_a_killed_worker_and_gives_the_bits_of_one_machine() {
    let [one, farm] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let words: Vec<&str> = ["render"].into_iter().chain(ARGUMENTS.split(' ')).collect();
    let alone = [&words[..], &["--frames", "0-5,9", "--out", "film.####.png"]].concat();
    assert!(rapidity(one.path(), &alone).status().unwrap().success());
    let whole = pictures(one.path());
    assert_eq!(whole.len(), 7);

    // A worker that is killed in its second chunk, after its first picture.
    let program = Path::new(env!("CARGO_BIN_EXE_rapidity"));
    let dying = farm.path().join("dying");
    let script = format!(
        "#!/bin/bash\necho chunk >> chunks\n[ $(wc -l < chunks) = 2 ] || exec '{0}' \"$@\"\n'{0}' \"${{@//3,4/3}}\"\nkill -9 $$\n",
        program.display()
    );
    fs::write(&dying, script).unwrap();
    fs::set_permissions(&dying, fs::Permissions::from_mode(0o755)).unwrap();
    let output = job(farm.path(), &dying);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(!output.status.success(), "a killed worker passed for a finished one:\n{said}");
    let left = pictures(farm.path());
    assert_eq!(left.len(), 4, "{said}");

    // The job is given out again.
    let output = job(farm.path(), program);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("openjd_progress: 100.0") && said.contains("there and whole"), "{said}");
    assert!(pictures(farm.path()) == whole, "the farm's pictures differ");
}

/// Text of a code block of docs/FARM.md that begins with this line.
fn block(first: &str) -> String {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/FARM.md")).unwrap();
    let lines = page.lines().skip_while(|line| line.trim() != first);
    let block: Vec<&str> = lines.take_while(|line| line.is_empty() || line.starts_with("    ")).collect();
    assert!(!block.is_empty(), "docs/FARM.md has no block that begins with {first}");
    block.iter().map(|line| line.trim_start_matches("    ")).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_scripts_for_slurm_make_every_picture() {
    // A stand-in for each task that Slurm would start.
    let folder = tempfile::tempdir().unwrap();
    let tools = tempfile::tempdir().unwrap();
    let program = tools.path().join("rapidity");
    let script = format!(
        "#!/bin/bash\nexec '{}' \"$@\" --scene lattice --size 64x36 --samples 1 --seconds 0.2 --fps 25\n",
        env!("CARGO_BIN_EXE_rapidity")
    );
    let page = block("#!/bin/bash");
    assert!(page.contains("#SBATCH --array=0-15") && page.contains("--part env"), "{page}");
    fs::write(&program, script).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    // The page's own film is long and large: here its arguments are replaced by those of the stand-in.
    let task = page.replace("--path tour.toml --projection sphere", "--beta 0,0,-0.6");
    fs::create_dir(folder.path().join("frames")).unwrap();
    for index in 0..3 {
        let path = format!("{}:{}", tools.path().display(), std::env::var("PATH").unwrap());
        let array = [("SLURM_ARRAY_TASK_ID", index.to_string()), ("SLURM_ARRAY_TASK_COUNT", "3".to_owned())];
        let mut shell = Command::new("bash");
        shell.arg("-c").arg(&task).current_dir(folder.path()).env("PATH", path).envs(array);
        let output = shell.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let names: Vec<String> = pictures(&folder.path().join("frames")).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["film.0000.png", "film.0001.png", "film.0002.png", "film.0003.png", "film.0004.png"]);
}
