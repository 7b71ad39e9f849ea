//! The test's side: where the loader finds the layer, the commands, and the journal.

use crate::layer::{COMMANDS, INSETS_EXTENSION, JOURNAL};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Name of the layer.
const NAME: &str = "XR_APILAYER_RAPIDITY_life";
/// Folder in which the system's own layers are declared.
const SYSTEM: &str = "/usr/share/openxr/1/api_layers/explicit.d";

/// Path of this crate's library, which cargo builds beside the tests that use it.
pub(crate) fn library() -> PathBuf {
    let test = std::env::current_exe().expect("the test has a path");
    let mut beside = test.ancestors().skip(1).take(2).map(|folder| folder.join("libxr_layer.so"));
    beside.find(|path| path.exists()).expect("cargo builds the layer beside the test")
}

/// Commands of a test to the layer in its program.
pub struct LayerScript {
    folder: PathBuf,
}

impl LayerScript {
    /// Declares the layer in a folder, in which commands and journal will lie, too.
    ///
    /// # Panics
    /// If the folder cannot be written, or the layer was not built beside the test.
    pub fn new(folder: &Path) -> Self {
        let manifest = format!(
            r#"{{"file_format_version": "1.0.0", "api_layer": {{"name": "{NAME}", "library_path": "{}",
                "api_version": "1.0", "implementation_version": "1", "description": "Life of a headset",
                "instance_extensions": [{{"name": "{INSETS_EXTENSION}", "extension_version": "1"}}]}}}}"#,
            library().display()
        );
        let script = Self { folder: folder.to_owned() };
        std::fs::write(folder.join("layer.json"), manifest).expect("the folder can be written");
        script.say(&[]);
        script
    }

    /// Makes a command run with the layer before those that it would have anyway.
    pub fn lead(&self, command: &mut Command) {
        let others = std::env::var("XR_ENABLE_API_LAYERS").unwrap_or_default();
        let layers = [NAME, &others].join(":");
        command.env("XR_ENABLE_API_LAYERS", layers.trim_end_matches(':'));
        // The loader looks nowhere else then.
        command.env("XR_API_LAYER_PATH", format!("{}:{SYSTEM}", self.folder.display()));
        command.env(COMMANDS, self.commands());
    }

    /// Gives commands, which are played out at once.
    ///
    /// # Panics
    /// If the folder cannot be written.
    pub fn say(&self, commands: &[&str]) {
        let text: String = commands.iter().map(|command| format!("{command}\n")).collect();
        let file = std::fs::File::options().create(true).append(true).open(self.commands());
        file.and_then(|mut file| file.write_all(text.as_bytes())).expect("the folder can be written");
    }

    /// Commands that were played out, and what the program did, in their order.
    pub fn journal(&self) -> Vec<String> {
        let text = std::fs::read_to_string(self.commands().with_extension(JOURNAL)).unwrap_or_default();
        text.lines().map(str::to_owned).collect()
    }

    fn commands(&self) -> PathBuf {
        self.folder.join("layer.commands")
    }
}
