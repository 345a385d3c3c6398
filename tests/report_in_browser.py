#!/usr/bin/env python3
"""report_in_browser.py: what a browser makes of the page of `--report`. usage: report_in_browser.py POLYLAB [FOLDER]

Drives headless Chromium by the WebDriver protocol; nothing but Python's standard library. Screenshots stay in FOLDER if it
is given. Last line: how many tests passed, failed or were skipped.
"""
import base64
import json
import os
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import time
import urllib.request
import zlib

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'golden', 'cases')
LEFT, MIDDLE, RIGHT = 0, 1, 2   # mouse buttons


class Browser:
    """One page in one headless Chromium."""

    def __init__(self, folder):
        with socket.socket() as probe:
            probe.bind(('127.0.0.1', 0))
            port = probe.getsockname()[1]
        self.driver = subprocess.Popen(['chromedriver', f'--port={port}'], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.at = f'http://127.0.0.1:{port}'
        flags = ['--headless', '--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader',
                 '--enable-unsafe-swiftshader', '--no-first-run', '--disable-background-networking', '--disable-component-update',
                 '--disable-sync', '--force-prefers-reduced-motion', '--window-size=1000,640', f'--user-data-dir={folder}']
        options = {'browserName': 'chrome', 'goog:chromeOptions': {'args': flags}, 'goog:loggingPrefs': {'browser': 'ALL'}}
        for _ in range(100):
            try:
                self.session = self.call('POST', '/session', {'capabilities': {'alwaysMatch': options}})['sessionId']
                break
            except urllib.error.URLError:
                time.sleep(0.1)
        else:
            raise SystemExit('chromedriver does not answer')
        self.at += '/session/' + self.session

    def call(self, method, path, body=None):
        request = urllib.request.Request(self.at + path, method=method, headers={'Content-Type': 'application/json'},
                                         data=None if body is None else json.dumps(body).encode())
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.load(answer)['value']

    def close(self):
        try:
            self.call('DELETE', '')
        finally:
            self.driver.terminate()
            self.driver.wait()

    def open(self, path):
        self.call('POST', '/url', {'url': 'file://' + os.path.abspath(path)})
        self.settle()

    def run(self, script):
        return self.call('POST', '/execute/sync', {'script': script, 'args': []})

    def settle(self):
        """Waits until what was asked for is drawn."""
        self.call('POST', '/execute/async', {'script': 'const done = arguments[0];'
                  'setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 50)', 'args': []})

    def element(self, css):
        return next(iter(self.call('POST', '/element', {'using': 'css selector', 'value': css}).values()))

    def click(self, css):
        self.call('POST', f'/element/{self.element(css)}/click', {})
        self.settle()

    def key(self, text):
        self.call('POST', f'/element/{self.element("#canvas")}/value', {'text': text})
        self.settle()

    def pointer(self, moves, button=None):
        """Moves the mouse to places of the canvas, counted from its centre; with a button held between first and last."""
        origin = {'element-6066-11e4-a52e-4f735466cecf': self.element('#canvas')}
        steps = [{'type': 'pointerMove', 'duration': 20, 'x': x, 'y': y, 'origin': origin} for x, y in moves]
        if button is not None:
            steps.insert(1, {'type': 'pointerDown', 'button': button})
            steps.append({'type': 'pointerUp', 'button': button})
        self.call('POST', '/actions', {'actions': [{'type': 'pointer', 'id': 'mouse', 'actions': steps}]})
        self.settle()

    def shot(self):
        """The canvas as it is seen: a PNG in base64. Equal pictures have equal texts."""
        return self.call('GET', f'/element/{self.element("#canvas")}/screenshot')

    def canvas(self):
        """Its pixels: (width, height, rows of RGB or RGBA bytes)."""
        return decode_png(base64.b64decode(self.shot()))

    def errors(self):
        log = self.call('POST', '/se/log', {'type': 'browser'})
        return [line['message'] for line in log if line['level'] in ('SEVERE', 'WARNING') and 'GPU stall' not in line['message']]


def decode_png(data):
    at, stream = 8, b''
    while at < len(data):
        length, kind = struct.unpack('>I4s', data[at:at + 8])
        content = data[at + 8:at + 8 + length]
        if kind == b'IHDR':
            width, height, _, colour_type = struct.unpack('>IIBB', content[:10])
        elif kind == b'IDAT':
            stream += content
        at += length + 12
    step = {0: 1, 2: 3, 3: 1, 6: 4}[colour_type]
    raw, before, rows = zlib.decompress(stream), bytearray(width * step), []
    for y in range(height):
        start = y * (width * step + 1)
        method, row = raw[start], bytearray(raw[start + 1:start + 1 + width * step])
        for i in range(len(row) if method else 0):
            a, b, c = (row[i - step] if i >= step else 0), before[i], (before[i - step] if i >= step else 0)
            near = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[i] = row[i] + (0, a, b, (a + b) // 2, near)[method] & 255
        rows.append(bytes(row))
        before = row
    return width, height, rows


def colours(image):
    width, _, rows = image
    step = len(rows[0]) // width
    found = {}
    for row in rows:
        for i in range(0, len(row), step):
            found[row[i:i + 3]] = found.get(row[i:i + 3], 0) + 1
    return found


class Tests:
    def __init__(self, program, folder, browser):
        self.program, self.folder, self.browser, self.passed, self.failed = program, folder, browser, 0, 0

    def check(self, what, holds):
        self.passed += bool(holds)
        self.failed += not holds
        if not holds:
            print(f'failed: {what}')

    def open(self, name, arguments):
        page = os.path.join(self.folder, name + '.html')
        if subprocess.run([self.program, *arguments, '--report', page], stdout=subprocess.DEVNULL, check=False).returncode > 1:
            raise SystemExit(f'polylab {" ".join(arguments)} gave no result')
        self.browser.open(page)
        self.keep(name)

    def keep(self, name):
        with open(os.path.join(self.folder, name + '.png'), 'wb') as file:
            file.write(base64.b64decode(self.browser.call('GET', '/screenshot')))

    def changes(self, what, action):
        before = self.browser.shot()
        action()
        self.check(what, self.browser.shot() != before)

    def valid_part(self):
        b = self.browser
        self.open('bracket', ['label', os.path.join(CASES, 'bracket', 'bracket.mesh'), '-o', os.path.join(self.folder, 'labels.txt')])
        common = sorted(colours(b.canvas()).items(), key=lambda item: -item[1])
        self.check('the canvas shows red, white and blue facets on grey', len([c for c in common if c[1] > 2000]) >= 4)
        self.check('a valid labeling has no problem in its list', 'valid' in b.run('return document.querySelector("#problems").textContent'))
        self.check('a column of statistics per labeling', b.run('return document.querySelectorAll("#statistics th").length') == 3)
        self.changes('dragging orbits', lambda: b.pointer([(0, 0), (60, 30), (90, 40)], LEFT))
        self.changes('the right button pans', lambda: b.pointer([(0, 0), (50, 0)], RIGHT))
        self.changes('an arrow key orbits', lambda: b.key('\ue012'))
        self.changes('+ zooms', lambda: b.key('+'))
        self.changes('Home goes back', lambda: b.key('\ue011'))
        self.changes('the naive labels differ from the final ones', lambda: b.click('#layers button:first-child'))
        self.check('a switched labeling is named', b.run('return document.querySelector("#verdict").textContent').startswith('naive'))
        self.changes('the fidelity map differs from the labels', lambda: b.click('#maps button:last-child'))
        b.key('3')
        b.key('f')
        b.pointer([(0, 100), (0, 0)])
        tip = b.run('const t = document.querySelector("#tip"); return t.hidden ? "" : t.textContent')
        self.check('hovering tells facet, label, fidelity and chart', all(w in tip for w in ('facet ', 'fidelity ', 'chart ', 'naive ')))
        self.changes('the part morphs to its polycube', lambda: b.run('set_morph(1)') or b.settle())
        self.keep('polycube')

    def invalid_part(self):
        b, part = self.browser, os.path.join(CASES, 'gear', 'in.obj')
        naive = os.path.join(self.folder, 'naive.txt')
        subprocess.run([self.program, 'label', part, '--method', 'naive', '-o', naive], check=True)
        for command in ('explain', 'stats'):
            self.open(command, [command, part, naive])
            listed = b.run('return document.querySelectorAll("#problems button").length')
            self.check(f'{command}: problems are listed', listed > 0)
            self.check(f'{command}: invalid elements stand out', sum(n for (r, g, bl), n in colours(b.canvas()).items()
                                                                      if r > 150 and g < 60 and 120 < bl < 240) > 50)
            self.changes(f'{command}: a click on a problem moves the view', lambda: b.click('#problems button'))
            self.changes(f'{command}: so does the key n', lambda: b.key('n'))
            self.keep(command + '-problem')

    def touch(self):
        b = self.browser
        self.open('touch', ['label', os.path.join(CASES, 'cube_12', 'in.obj'), '-o', os.path.join(self.folder, 'labels.txt')])
        fingers = lambda ways: [{'type': 'pointer', 'id': f'finger{i}', 'parameters': {'pointerType': 'touch'}, 'actions': [
            {'type': 'pointerMove', 'duration': 0, 'x': x0, 'y': y0}, {'type': 'pointerDown', 'button': 0},
            {'type': 'pointerMove', 'duration': 50, 'x': x1, 'y': y1}, {'type': 'pointerUp', 'button': 0}]}
            for i, (x0, y0, x1, y1) in enumerate(ways)]
        zoom = b.run('return camera.zoom')
        b.call('POST', '/actions', {'actions': fingers([(300, 300, 200, 300), (400, 300, 500, 300)])})
        b.settle()
        self.check('two fingers zoom', b.run('return camera.zoom') > 2 * zoom)
        yaw = b.run('return camera.yaw')
        b.call('POST', '/actions', {'actions': fingers([(300, 300, 400, 300)])})
        b.settle()
        self.check('one finger orbits', b.run('return camera.yaw') < yaw)


def main():
    if len(sys.argv) not in (2, 3):
        raise SystemExit(__doc__.split('\n')[0])
    missing = [tool for tool in ('chromium', 'chromedriver') if not shutil.which(tool)]
    if missing:
        print(f'skipped: {" and ".join(missing)} is not here (apt-get install chromium chromium-driver)\n0 passed, 0 failed, 26 skipped')
        return 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = os.path.abspath(sys.argv[2]) if len(sys.argv) == 3 else scratch
        os.makedirs(folder, exist_ok=True)
        browser = Browser(os.path.join(scratch, 'profile'))
        try:
            tests = Tests(os.path.abspath(sys.argv[1]), folder, browser)
            for part in (tests.valid_part, tests.invalid_part, tests.touch):
                part()
                errors = browser.errors()
                tests.check(f'{part.__name__}: the console has no error: {errors}', not errors)
        finally:
            browser.close()
    print(f'{tests.passed} passed, {tests.failed} failed')
    return 1 if tests.failed else 0


if __name__ == '__main__':
    sys.exit(main())
