#!/usr/bin/env python3
"""dataset_steps.py: the steps of tools/dataset.smk: which parts there are, one part, the tables of all."""
import csv
import html
import json
import os
import re
import subprocess
import sys
from collections import namedtuple
from urllib.parse import quote

CAD = ('.step', '.stp', '.brep', '.iges', '.igs', '.geo')
MESHES = ('.obj', '.stl', '.mesh')
MAMBO = {'B': 'Basic', 'S': 'Simple', 'M': 'Medium'}   # subsets of MAMBO, by the first letter of B0 … M9
CLASSES = {'valid_monotone': 'valid, all monotone', 'valid_turning_points': 'valid, with turning-points',
           'invalid': 'invalid', 'failed': 'failed'}
METHODS = ('graph-cut', 'polylab')

Model = namedtuple('Model', 'name subset path')


def find_models(root):
    """All parts below a folder, by name. Of files that differ in the extension only, CAD comes first."""
    models = []
    for folder, subfolders, files in os.walk(root):
        subfolders.sort()
        at = os.path.relpath(folder, root)
        if 'surface.obj' in files and at != '.':
            models.append((at, 'surface.obj'))
            subfolders.clear()
            continue
        chosen = {}
        for file in files:
            stem, extension = os.path.splitext(file)
            if extension.lower() in CAD + MESHES:
                chosen.setdefault(stem, []).append(((CAD + MESHES).index(extension.lower()), file))
        models += [(os.path.normpath(os.path.join(at, stem)), os.path.join('..', min(found)[1])) for stem, found in chosen.items()]
    out = []
    for name, file in models:
        folder, stem = os.path.split(name)
        letter = re.fullmatch(r'([BSM])\d+', stem) if not folder else None
        path = os.path.normpath(os.path.join(root, name, file))
        out.append(Model(name, MAMBO[letter[1]] if letter else folder or os.path.basename(os.path.abspath(root)), path))
    return sorted(out, key=lambda m: [int(t) if t.isdigit() else t for t in re.split(r'(\d+)', m.name)])


def measure(json_file, seconds):
    with open(json_file, encoding='utf-8') as file:
        s = json.load(file)
    return {'class': s['polylab']['class'], 'facets': s['polylab']['facets'], 'charts': s['charts']['nb'],
            'corners': s['corners']['nb'],
            'invalid': s['charts']['invalid'] + s['boundaries']['invalid'] + s['corners']['invalid'],
            'turning_points': s['turning-points']['nb'], 'fidelity': s['fidelity']['avg'], 'fidelity_min': s['fidelity']['min'],
            'preserved': s['feature-edges']['preserved'], 'lost': s['feature-edges']['lost'],
            'ignored': s['feature-edges']['removed'], 'seconds': seconds}


def run_model(part, folder, program, size):
    """Labels one part; its files and row.json go to `folder`. Never fails: that is a class of its own."""
    os.makedirs(folder, exist_ok=True)
    at = lambda name: os.path.join(folder, name)
    log = []

    def run(*command):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors='replace', check=False)
        log.append(done.stdout)
        if done.returncode not in (0, 1):
            last = (done.stdout.strip().split('\n') or [''])[-1]
            raise RuntimeError(last or f'{os.path.basename(command[0])} ended with status {done.returncode}')
        return done.stdout

    row = {'error': '', 'results': {}}
    try:
        if part.lower().endswith(CAD):
            tool = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'cad2labels')
            said, surface = run(tool, part, '-o', folder, '--size', size, '--polylab', program), at('surface.obj')
        else:
            said, surface = run(program, 'label', part, '-o', at('surface_labeling.txt'), '--stats', at('labeling.stats.json'),
                                '--report', at('report.html'), '--picture', at('picture.png'), '--verbose'), part
        seconds = [float(re.search(rf'{which} labeling after ([0-9.]+) s', said)[1]) for which in ('initial', 'final')]
        run(program, 'label', surface, '--method', 'graphcut', '-o', at('graphcut.txt'), '--stats', at('graphcut.stats.json'))
        row['results'] = {'graph-cut': measure(at('graphcut.stats.json'), seconds[0]),
                          'polylab': measure(at('labeling.stats.json'), seconds[1])}
    except (RuntimeError, OSError, KeyError, ValueError, TypeError) as error:
        row['error'] = str(error)
    with open(at('log.txt'), 'w', encoding='utf-8') as file:
        file.write('\n'.join(log))
    with open(at('row.json'), 'w', encoding='utf-8') as file:
        json.dump(row, file, indent=1)


def table_rows(models, rows):
    """The paper's table: for each subset and method a dict of texts."""
    subsets = list(dict.fromkeys(m.subset for m in models))
    subsets.sort(key=lambda s: [*MAMBO.values()].index(os.path.basename(s)) if os.path.basename(s) in MAMBO.values() else -1)
    groups = [(s, [m for m in models if m.subset == s]) for s in subsets]
    if len(groups) > 1:
        groups.append(('all', models))
    percent = lambda n, of: f'{100 * n / of:.1f} %' if of else '-'
    for subset, members in groups:
        for method in METHODS:
            results = [rows[m.name]['results'].get(method) for m in members]
            done = [r for r in results if r]
            line = {'subset (size)': f'{subset} ({len(members)})', 'method': method}
            cumulative = 0
            for key, title in CLASSES.items():
                n = len(results) - len(done) if key == 'failed' else sum(r['class'] == key for r in done)
                cumulative += n
                line[title] = percent(n, len(members))
                line[f'cumulative: {title}'] = percent(cumulative, len(members))
            line['average fidelity'] = f'{sum(r["fidelity"] for r in done) / len(done):.3f}' if done else '-'
            edges = {key: sum(r[key] for r in done) for key in ('preserved', 'lost', 'ignored')}
            for key, n in edges.items():
                line[f'feature edges {key}'] = percent(n, sum(edges.values()))
            line['seconds'] = f'{sum(r["seconds"] for r in done):.2f}'
            yield line


def text_table(lines):
    """Side by side as in the paper: a part of four classes per row, ratio and cumulative in columns."""
    out = [f'{"subset (size)":34} {"method":10} {"class":27} {"ratio":>8} {"cumul.":>8} {"fidelity":>9}  feature edges          {"seconds":>9}']
    for line in lines:
        feature = [f'{key:9} {line[f"feature edges {key}"]:>8}' for key in ('preserved', 'lost', 'ignored')] + ['']
        for i, title in enumerate(CLASSES.values()):
            first = [line['subset (size)'], line['method'], line['average fidelity'], line['seconds']] if i == 0 else [''] * 4
            out.append(f'{first[0]:34} {first[1]:10} {title:27} {line[title]:>8} {line["cumulative: " + title]:>8} '
                       f'{first[2]:>9}  {feature[i]:22} {first[3]:>9}'.rstrip())
    return '\n'.join(out) + '\n'


STYLE = '''body { font: 15px/1.4 system-ui, sans-serif; margin: 1.5em; color: #1c232b; background: #f4f6f8; }
table { display: block; overflow-x: auto; border-collapse: collapse; font-size: 13px; } td, th { padding: 3px 8px; border: 1px solid #c5ccd4; text-align: right; }
td:nth-child(-n+2) { text-align: left; } h2 { font-size: 17px; margin: 1.4em 0 .5em; } tr:nth-child(odd) td { font-weight: 600; }
.parts { display: grid; grid-template-columns: repeat(auto-fill, minmax(170px, 1fr)); gap: 10px; }
.parts a { padding: 8px; border-top: 5px solid #2e7d4f; background: #fff; color: inherit; text-decoration: none; font-size: 13px; }
.parts a.valid_turning_points { border-color: #f2b600; } .parts a.invalid, .parts a.failed { border-color: #d8009f; }
.parts img { display: block; width: 100%; aspect-ratio: 1; } .parts b { display: block; overflow-wrap: anywhere; }
.parts p { display: grid; place-items: center; aspect-ratio: 1; margin: 0; overflow: hidden; overflow-wrap: anywhere; }'''


def page(title, models, rows, lines):
    def link(m):
        return html.escape('models/' + '/'.join(map(quote, m.name.split('/'))))

    def card(m):
        name, result = html.escape(os.path.basename(m.name)), rows[m.name]['results'].get('polylab')
        if not result:
            return f'<a class="failed" href="{link(m)}/log.txt"><p>{html.escape(rows[m.name]["error"])}</p><b>{name}</b>failed</a>'
        return (f'<a class="{result["class"]}" href="{link(m)}/report.html"><img loading="lazy" src="{link(m)}/picture.png" alt="">'
                f'<b>{name}</b>{CLASSES[result["class"]]}<br>fidelity {result["fidelity"]:.3f}, {result["seconds"]:.2f} s</a>')

    out = [f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
           f'<title>{html.escape(title)} - polylab</title><link rel="icon" href="data:,"><style>{STYLE}</style></head><body>',
           f'<h1>{html.escape(title)}</h1>', '<table>', '<tr>' + ''.join(f'<th>{html.escape(k)}</th>' for k in lines[0]) + '</tr>']
    out += ['<tr>' + ''.join(f'<td>{html.escape(v)}</td>' for v in line.values()) + '</tr>' for line in lines]
    out.append('</table>')
    for subset in dict.fromkeys(m.subset for m in models):
        out.append(f'<h2>{html.escape(subset)}</h2><div class="parts">')
        out += [card(m) for m in models if m.subset == subset]
        out.append('</div>')
    return '\n'.join(out + ['</body></html>']) + '\n'


def write_tables(root):
    models, rows = find_models(root), {}
    for m in models:
        with open(f'models/{m.name}/row.json', encoding='utf-8') as file:
            rows[m.name] = json.load(file)
    lines = list(table_rows(models, rows))
    with open('table.csv', 'w', newline='', encoding='utf-8') as file:
        writer = csv.DictWriter(file, lines[0])
        writer.writeheader()
        writer.writerows(lines)
    with open('models.csv', 'w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file)
        columns = ['class', 'facets', 'charts', 'corners', 'invalid', 'turning_points', 'fidelity', 'fidelity_min', 'preserved',
                   'lost', 'ignored', 'seconds']
        writer.writerow(['name', 'subset', 'method', *columns, 'error'])
        for m in models:
            for method in METHODS:
                result = rows[m.name]['results'].get(method, {'class': 'failed'})
                writer.writerow([m.name, m.subset, method, *(result.get(c, '') for c in columns), rows[m.name]['error']])
    for name, text in (('table.txt', text_table(lines)), ('index.html', page(os.path.basename(root), models, rows, lines))):
        with open(name, 'w', encoding='utf-8') as file:
            file.write(text)


if __name__ == '__main__':
    step, arguments = sys.argv[1], sys.argv[2:]
    if step == 'list':
        found = find_models(arguments[0])
        if not found:
            sys.exit(f'dataset: {arguments[0]}: expected parts ({" ".join(CAD + MESHES)}), found none')
        print('\n'.join(m.name for m in found))
    elif step == 'model':
        run_model(*arguments)
    elif step == 'tables':
        write_tables(*arguments)
