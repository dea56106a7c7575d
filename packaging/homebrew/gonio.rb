class Gonio < Formula
  desc "Light lab: lights models with the light equation, checks students' shaders"
  homepage "{{repository}}"
  version "{{version}}"
  license any_of: ["MIT", "Apache-2.0"]

  on_macos do
    url "{{url:universal-apple-darwin}}"
    sha256 "{{sha256:universal-apple-darwin}}"
  end

  on_linux do
    on_intel do
      url "{{url:x86_64-unknown-linux-gnu}}"
      sha256 "{{sha256:x86_64-unknown-linux-gnu}}"
    end
  end

  def install
    bin.install "gonio"
    man1.install Dir["man/*.1"]
    bash_completion.install "completions/gonio.bash" => "gonio"
    zsh_completion.install "completions/_gonio"
    fish_completion.install "completions/gonio.fish"
    doc.install "README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY.txt"
  end

  test do
    system bin/"gonio", "render", "builtin:cube", "--backend", "cpu", "--size", "32x32", "-o", "cube.png"
    assert_path_exists testpath/"cube.png"
  end
end
